"""Reads a page as a browser would and prints what tests ask about, as JSON.

Names what is not closed or closed twice, attributes and identifiers given twice, what is loaded from elsewhere and
links within the page that lead nowhere; counts scripts and pictures; lists numbers (data-name: data-value), commands
and text.
"""
import html.parser
import json
import sys

VOID = {"meta", "img", "source", "br", "hr", "link", "input"}
LOADING = {"src", "srcset", "href", "xlink:href", "data", "poster", "action"}


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.open, self.faults, self.ids, self.links = [], [], set(), []
        self.numbers, self.commands, self.text, self.scripts, self.pictures = {}, [], [], 0, 0

    def handle_starttag(self, tag, attrs):
        names = [name for name, _ in attrs]
        if len(names) != len(set(names)):
            self.faults.append(f"{tag}: an attribute twice")
        found = dict(attrs)
        self.scripts += tag == "script" or any(name.startswith("on") for name in names)
        self.pictures += tag == "img"
        if "id" in found:
            if found["id"] in self.ids:
                self.faults.append(f"id twice: {found['id']}")
            self.ids.add(found["id"])
        for name in LOADING & set(names):
            value = found[name] or ""
            if value.startswith("#"):
                self.links.append(value[1:])
            elif not value.startswith("data:image/png;base64,"):
                self.faults.append(f"{tag} {name}={value[:80]}")
        if found.get("data-name"):
            self.numbers[found["data-name"]] = float(found["data-value"])
        if tag not in VOID:
            self.open.append((tag, found.get("class", "")))

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open[-1][0] != tag:
            self.faults.append(f"</{tag}> at {self.getpos()}, open: {self.open[-1:]}")
        else:
            self.open.pop()

    def handle_data(self, data):
        if self.open and self.open[-1] == ("code", "command"):
            self.commands.append(data)
        if self.open and self.open[-1][0] not in ("style", "script"):
            self.text.append(data)


source = open(sys.argv[1], encoding="utf-8").read()
page = Page()
page.feed(source)
page.close()
style = source[source.index("<style>"):source.index("</style>")]
if "url(" in style or "@import" in style:
    page.faults.append("the style loads something")
page.faults += [f"{tag} is not closed" for tag, _ in page.open]
page.faults += [f"#{link} leads nowhere" for link in page.links if link not in page.ids]
print(json.dumps({"faults": page.faults, "scripts": page.scripts, "pictures": page.pictures, "numbers": page.numbers,
                  "commands": page.commands, "text": " ".join(" ".join(page.text).split())}))
