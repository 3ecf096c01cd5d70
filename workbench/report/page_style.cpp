// The page's look: plain, dense, of the reader's own fonts. Gnuplot writes a figure's colours as attributes of its
// elements, which any rule here overrides: so figures follow the theme, too.
#include "workbench/report/page.h"

namespace tangent {

const char* page_style() {
  return R"css(
:root { color-scheme: light dark; --ground: #ffffff; --ink: #1d2228; --dim: #5c6670; --line: #d8dde2; --soft: #f3f5f7;
  --accent: #00629b; --good: #1a7f37; --bad: #b3261e; --figure-line: #444444; --figure-grid: #e3e3e3; }
@media screen and (prefers-color-scheme: dark) {
  :root { --ground: #15191e; --ink: #e4e8ec; --dim: #98a3ad; --line: #343b43; --soft: #1d232a; --accent: #6db8ea;
    --good: #5fce7b; --bad: #ff8a80; --figure-line: #aab3bc; --figure-grid: #2d343c; }
  .figure [stroke="rgb(  0, 114, 178)"] { stroke: #4aa3df; }
  .figure [color="rgb(  0, 114, 178)"] { color: #4aa3df; }
  .figure [color="rgb(213,  94,   0)"] { color: #ff9a5c; }
  .figure [fill="rgb(  0, 114, 178)"] { fill: #6db8ea; }
  .figure [fill="rgb(  0, 158, 115)"] { fill: #3fd0a4; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.5rem 4rem; max-width: 64rem; background: var(--ground); color: var(--ink);
  font: 15px/1.5 Inter, "Helvetica Neue", Arial, "Liberation Sans", sans-serif; }
h1 { font-size: 1.75rem; line-height: 1.2; margin: 0 0 .25rem; }
h2 { font-size: 1.3rem; margin: 3rem 0 .5rem; padding-top: .75rem; border-top: 2px solid var(--line); }
h3 { font-size: 1.05rem; margin: 2rem 0 .5rem; }
h4 { font-size: .95rem; margin: 0 0 .25rem; }
h1, h2 { overflow-wrap: anywhere; }
p { margin: .4rem 0; max-width: 46rem; overflow-wrap: anywhere; }
a { color: var(--accent); }
.dim { color: var(--dim); }
.good { color: var(--good); } .bad { color: var(--bad); }
nav ul { padding-left: 1.1rem; margin: .75rem 0 0; }
.table { margin: .75rem 0 1.25rem; overflow-x: auto; }
table { border-collapse: collapse; font-size: .875rem; }
caption { text-align: left; color: var(--dim); padding: 0 0 .35rem; }
th, td { padding: .28rem .8rem .28rem 0; text-align: left; vertical-align: top; border-bottom: 1px solid var(--line); }
th { font-weight: 600; color: var(--dim); }
.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td { overflow-wrap: anywhere; }
td.number { overflow-wrap: normal; }
table.wide { font-size: .8rem; }
table.wide th, table.wide td { padding-right: .55rem; }
.wide td:first-child { white-space: nowrap; }
ul.values { columns: 3; list-style: none; padding: 0; margin: .25rem 0 1rem; font-size: .875rem; color: var(--dim); }
ul.values b { color: var(--ink); font-weight: 500; }
code { font: .8125rem/1.45 "JetBrains Mono", "DejaVu Sans Mono", Consolas, monospace; }
code.command { display: block; margin: .4rem 0; padding: .35rem .6rem; background: var(--soft); color: var(--dim);
  border-left: 3px solid var(--line); white-space: pre-wrap; overflow-wrap: anywhere; }
figure { margin: 1rem 0 1.5rem; }
figcaption { color: var(--dim); font-size: .875rem; max-width: 46rem; }
.figure svg { display: block; width: 100%; height: auto; }
.figure.narrow svg { max-width: 40rem; }
.figure [color="black"] { color: var(--figure-line); }
.figure [stroke="rgb( 68,  68,  68)"], .figure [stroke="rgb(119, 119, 119)"] { stroke: var(--figure-line); }
.figure [stroke="rgb(227, 227, 227)"] { stroke: var(--figure-grid); }
.figure [fill="rgb(34,34,34)"], .figure [fill="rgb(68,68,68)"], .figure [fill="black"] { fill: var(--ink); }
.figure [stroke="rgb( 51,  51,  51)"], .figure [stroke="rgb( 34,  34,  34)"] { stroke: var(--ink); }
.figure [color="rgb( 34,  34,  34)"] { color: var(--ink); }
.figure [color="white"] { color: var(--ground); }
.figure [fill="rgb(179,38,30)"] { fill: var(--bad); }
.worst { display: grid; grid-template-columns: minmax(0, 26rem) minmax(0, 1fr); gap: 1.25rem;
  margin: 1.25rem 0 1.75rem; }
.worst img { display: block; width: 100%; height: auto; border: 1px solid var(--line); border-radius: 4px; }
.letter { display: inline-block; min-width: 1.5em; margin-right: .4em; text-align: center;
  border: 1px solid currentColor; border-radius: 4px; }
@media screen and (max-width: 48rem) { .worst { grid-template-columns: 1fr; } ul.values { columns: 1; } }
@media print {
  @page { size: A4; margin: 16mm 14mm; }
  body { max-width: none; padding: 0; font-size: 9.5pt; }
  h2 { break-before: page; border-top: none; padding-top: 0; margin-top: 0; }
  h2, h3, h4, caption { break-after: avoid; }
  figure, .worst, table, code.command { break-inside: avoid; }
  .worst { grid-template-columns: 8cm 1fr; }
  .table { overflow: visible; }
  nav { display: none; }
  a { color: inherit; text-decoration: none; }
}
)css";
}

}  // namespace tangent
