# The page in a browser: what it draws, and that each switch, column, frame and key changes what it says; in the dark
# and on a phone.
. "$TOP/tests/page/begin"
mr-make sphere -n 20000 | mr-view sphere.html || exit
mr-make bumpy -n 2500 | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 |
	mr-solve --basis |
	mr-encode | mr-pose -q -H 1 --rotate 0,0,1,40 --frames 3 | mr-decode -q -o film.mrs || exit
mr-view -i film.mrs film.html || exit
{ mr-make torus -n 500; mr-make cube -n 500; mr-make torus -n 500 | mr-smooth; } | mr-view two.html || exit
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng red <b>\nf 1 2 3\ng green\nf 1 3 4\n' | mr-import |
	mr-view --title 'A <b>' --caption 'Red & green.' --name "two'; groups.mrs" groups.html || exit
mr-make torus --points 500 | mr-view points.html || exit
python3 - >void.mrs <<'X'
import sys
from records import END, START, frame, record
sys.stdout.buffer.write(START + frame(b"key void", record(b"handles", b"transform", b"vd\14", 1, bytes(96))) + END)
X
mr-view -i void.mrs void.html || exit
exec python3 "$TOP/tests/page/look.py"
