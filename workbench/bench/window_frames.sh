#!/bin/bash
# window_frames.sh WORKBENCH OUT: the real window at 1920 x 1080 on Xvfb with software OpenGL, everything on, live.
# Prints frames a second, the time of a frame, and from an injected key or move of the mouse to the frame that shows it.
# Writes OUT.csv (a line a frame), OUT.ev (what was injected when), OUT.log. Needs xvfb, xdotool and python3.
W=$1; OUT=$(realpath -m "$2"); SCRIPT=$(dirname "$(realpath "$0")")/window_everything.txt; n=$((31000 + $$ % 1000))
export DISPLAY=:$n LIBGL_ALWAYS_SOFTWARE=1 XDG_CONFIG_HOME=$OUT.cfg XDG_DATA_HOME=$OUT.cfg
rm -rf $OUT.cfg; mkdir -p $OUT.cfg/tangent-workbench; echo 'format = 1' > $OUT.cfg/tangent-workbench/window.toml
Xvfb $DISPLAY -noreset -screen 0 1920x1080x24 >/dev/null 2>&1 & X=$!
sleep 1
TANGENT_FRAME_TIMES=$OUT.csv $W gui torus --script $SCRIPT >$OUT.log 2>&1 & P=$!
for i in $(seq 100); do
  id=$(xdotool search --name 'Tangent Workbench' 2>/dev/null | head -1); [ -n "$id" ] && break; sleep 0.1
done
xdotool windowmove $id 0 0 windowsize $id 1920 1080; sleep 14
now() { python3 -c 'import time; print(time.monotonic())'; }
echo "live_from $(now)" > $OUT.ev; sleep 8; echo "live_to $(now)" >> $OUT.ev
python3 - $OUT <<'PY'
import subprocess,time,sys,random
out=sys.argv[1]; ev=open(out+'.ev','a')
p=subprocess.Popen(['xdotool','-'],stdin=subprocess.PIPE,text=True)
def do(kind,c):
    p.stdin.write(c+'\n'); p.stdin.flush(); ev.write(f'{kind} {time.monotonic()}\n'); 
random.seed(1)
do('warm','mousemove 900 300'); time.sleep(1)
for i in range(40):
    do('key','key Shift_L'); time.sleep(0.23+0.1*random.random())
for i in range(40):
    do('move',f'mousemove {800+5*i} 300'); time.sleep(0.23+0.1*random.random())
ev.write(f'orbit_from {time.monotonic()}\n')
p.stdin.write('mousedown 1\n')
for i in range(250):
    p.stdin.write(f'mousemove {1000+(i%40)*4} {300+i%30}\n'); p.stdin.flush(); time.sleep(0.02)
p.stdin.write('mouseup 1\n'); p.stdin.flush()
ev.write(f'orbit_to {time.monotonic()}\n'); p.stdin.close(); p.wait(); ev.close()
PY
sleep 0.5; xdotool windowfocus $id key ctrl+q; for i in $(seq 50); do kill -0 $P 2>/dev/null || break; sleep 0.1; done
kill $P 2>/dev/null; kill $X; wait 2>/dev/null
python3 - $OUT <<'PY'
import sys,csv
out=sys.argv[1]
fr=[(float(r['begin_s']),float(r['end_s']),int(r['input']),int(r['drawn'])) for r in csv.DictReader(open(out+'.csv'))]
ev=[(l.split()[0],float(l.split()[1])) for l in open(out+'.ev')]
t=dict(ev)
def q(v,p): v=sorted(v); return v[min(len(v)-1,int(p*len(v)))] if v else float('nan')
def stat(name,a,b):
    f=[x for x in fr if x[0]>=a and x[1]<=b]
    d=[1e3*(x[1]-x[0]) for x in f]; iv=[1e3*(y[0]-x[0]) for x,y in zip(f,f[1:])]
    print(f'{name}: {len(f)/(b-a):.1f} frames/s, frame p50 {q(d,.5):.1f} p99 {q(d,.99):.1f} ms; '
          f'interval p50 {q(iv,.5):.1f} p99 {q(iv,.99):.1f} max {max(iv):.1f} ms')
stat('live',t['live_from'],t['live_to']); stat('orbit',t['orbit_from'],t['orbit_to'])
for kind in ('key','move'):
    l=[]
    for k,s in ev:
        if k!=kind: continue
        f=next((x for x in fr if x[2] and x[1]>s),None)
        if f: l.append(1e3*(f[1]-s))
    print(f'{kind} to shown: n {len(l)} p50 {q(l,.5):.1f} p99 {q(l,.99):.1f} max {max(l):.1f} ms')
PY
