# Several streams in one page: their frames one behind the other, each with the name of its file.
stream_of() { # page: the stream that it holds
	python3 - "$1" <<'P'
import base64, re, sys
page = open(sys.argv[1], encoding="utf-8").read()
for block in re.findall('<script type="text/plain" class="stream">([A-Za-z0-9+/=]*)</script>\n', page):
	sys.stdout.buffer.write(base64.b64decode(block, validate=True))
P
}
told() { # page: each frame, and what its text says of the file
	stream_of "$1" >told.mrs && mr-cat -u --no-history told.mrs | python3 -c '
import records, sys
for _, name, _, _, text in records.read(sys.stdin.buffer.read()):
	if name == b"FRAME":
		print(text.decode())
	if name == b"page":
		print("\t" + " ".join(line for line in text.decode().split("\n") if line.startswith("file")))'
}
mr-make torus -n 100 | mr-smooth | mr-select --free all --handle 0=above:z,0.8 | mr-pose --frames 1 --translate 1,0,0 | mr-solve -q -o film.mrs
mr-make cube -n 100 -o cube.mrs
mr-make sphere -n 100 | mr-export ball.obj
mr-view -q page.html film.mrs cube.mrs ball.obj && told page.html
echo '-- as one stream, but for that'
mr-import -q ball.obj | cat film.mrs cube.mrs - | mr-view -q one.html && told one.html
echo '-- the same twice, stdin between, and odd names'
cp cube.mrs "a b's <i>.x.mrs" && cp cube.mrs .mrs
mr-view page.html cube.mrs - cube.mrs "a b's <i>.x.mrs" ./.mrs <cube.mrs && told page.html
echo '-- the same bytes again, in --stats all frames'
mr-view -j 3 --stats stats again.html cube.mrs - cube.mrs "a b's <i>.x.mrs" ./.mrs <cube.mrs && cmp page.html again.html && grep -o '"frame":[0-9]*' stats
echo '-- models but the first in files beside it: the same frames'
mr-view -q --beside beside.html film.mrs cube.mrs ball.obj film.mrs && told beside.html && ls beside.*
for i in 2 3 4; do
	tr -d '\n' <beside.$i.js | sed -E 's/^mrPart\("([^"]*)"\);$/\1/' | base64 -d | mr-info --json --no-intersections | tr , '\n' | grep -c '"frame"'
done
echo '-- one that fails leaves no page'
head -c 1000 film.mrs >cut.mrs
for files in 'cube.mrs absent.mrs' 'cut.mrs cube.mrs' 'cube.mrs cut.mrs' 'cube.mrs page.html'; do
	mr-view none.html $files 2>err; echo "exit $?: $(cat err)"
done
ls none.html mr-*~ 2>/dev/null || echo 'no page'
mr-view --stats cube.mrs none.html film.mrs cube.mrs 2>err; echo "exit $?: $(head -n 1 err)"
mr-info cube.mrs >/dev/null && echo 'the stream is there'
