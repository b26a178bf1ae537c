# Where handles go: single poses, chains, sequences, scripts.
cat >values.py <<'END'
# What each frame of a stream sends of handles.transform, or of its turns, rounded; nothing where it sends none.
import math, records, sys
wanted, unit = (b'turn', 180 / math.pi) if sys.argv[1:] else (b'transform', 1)
for layer, column, shape, _, body in records.read(sys.stdin.buffer.read()):
    if column == b'FRAME':
        print(body.decode() + ':', end='')
    elif column == b'ENDFRAME':
        print()
    elif (layer, column) == (b'handles', wanted):
        for x in records.numbers(shape, body):
            print('', format(round(x * unit, 6) + 0, 'g'), end='')
END
values() {
	python3 values.py
}
echo 0 >corner
mr-make cube -n 8 | mr-select --free all --handle 0=above:z,1 --handle 2=vertices:corner -o cube.mrs

echo 'moved, turned, scaled'
mr-pose --translate 1,2,3 cube.mrs | values
mr-pose --rotate 0,0,2,90 cube.mrs | values # about (0, 0, 1)
mr-pose --scale 2 cube.mrs | values
mr-pose -H 2 --scale 1,2,3 --center 0,0,0 cube.mrs | values
mr-pose cube.mrs | values # to rest: the identity

echo 'in a chain'
mr-pose --translate 1,0,0 cube.mrs | mr-pose --rotate 1,0,0,90 | mr-pose -H 2 --scale 3 --center 0,0,0 | values
mr-pose --translate 1,0,0 --rotate 1,0,0,90 cube.mrs | mr-pose -H 2 --scale 3 --center 0,0,0 | values

echo 'turns, in degrees, which a matrix forgets'
turns() {
	python3 values.py turn
}
mr-pose --rotate 0,0,2,450 cube.mrs | turns
mr-pose --rotate 0,0,1,150 cube.mrs | mr-pose --rotate 0,0,1,150 | mr-pose --rotate 0,0,1,150 --scale 2 | turns
mr-pose --rotate 0,1,0,-720 --frames 4 cube.mrs | mr-pose -H 2 --rotate 1,0,0,270 --frames 2 | turns
mr-pose --rotate 0,0,1,90 cube.mrs | mr-pose --rotate 1,0,0,90 | turns # a third of a turn about (1, -1, 1)

echo 'in a sequence'
mr-pose --translate 0,0,4 --scale 16 --center 0,0,0 --frames 4 cube.mrs | values
echo 'two handles, the second in half of the time'
mr-pose --translate 0,0,4 --frames 4 cube.mrs | mr-pose -H 2 --translate 1,0,0 --frames 2 | values
echo 'a frame of a sequence is the same as alone'
mr-pose --rotate 1,2,3,50 --frames 2 cube.mrs | values | sed -n 's/.*0001://p' >middle
mr-pose --rotate 1,2,3,25 cube.mrs | values | sed 's/.*cube://' | cmp - middle && echo same
echo 'all of an input sequence is posed, the key too'
mr-pose --translate 0,0,2 --frames 2 cube.mrs | mr-pose --translate 1,0,0 | values
echo 'every key begins a sequence'
mr-cat cube.mrs cube.mrs | mr-pose --translate 0,0,2 --frames 2 | values

echo 'by script'
cat >script <<'END'
# up, and then back
frame
0 translate=0,0,1   # up
2 scale=2 center=0,0,0
frame
frame
0 translate=0,0,1 rotate=0,0,1,180 center=0,0,0
0 translate=5,0,0
END
mr-pose --script script cube.mrs | values
mr-pose --script script cube.mrs | mr-pose --script script | values | tail -n 1

echo 'refusals'
refused() {
	mr-pose "$@" cube.mrs >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
}
refused -H 1 --scale 2
refused -H 3 --scale 2
refused -H x
refused --rotate 0,0,0,30
refused --rotate 0,0,1
refused --rotate 0,0,1,1e300
refused --scale 1,2
refused --translate 1,2,3,4
refused --scale 0 --frames 3
refused --script script --frames 3
refused --script absent
echo '0 scale=2' >wrong
refused --script wrong
printf 'frame\n0 grow=2\n' >wrong
refused --script wrong
printf 'frame\n1 scale=2\n' >wrong
mr-pose --script wrong cube.mrs >out
echo "exit $?"
printf 'frame\n0 scale=2\nframe\n0 scale=3\nframe\n0 scale=4\n' >long
mr-pose --translate 0,1,0 --frames 2 cube.mrs | mr-pose --script long | mr-info | grep -c '^cube'
mr-make cube -n 8 | mr-pose --scale 2 >out
mr-make cube -n 8 | mr-select --free all | mr-pose --scale 2 >out

echo 'words twice, a handle without any, the mark of UTF-8, a mirror'
printf 'frame\n0 translate=1,0,0 translate=0,1,0\n' >wrong
refused --script wrong
printf 'frame\n0\n' >wrong
refused --script wrong
printf '\357\273\277frame\n0 translate=0,0,1\n' >marked
mr-pose --script marked cube.mrs | values
mr-pose --scale -1,1,1 cube.mrs 2>&1 >out
echo 'a film that has been decoded is posed as it is, and made into no other'
mr-make sphere -n 200 | mr-smooth -t 0 | mr-select --free all --fixed below:z,0.2 --handle 0=above:z,0.8 | mr-encode |
    mr-pose --translate 0,0,1 --frames 2 | mr-solve | mr-decode -o film.mrs
mr-pose --translate 1,0,0 --frames 2 film.mrs 2>&1 >out | grep -o 'this frame.*'
mr-pose --translate 1,0,0 film.mrs | mr-solve | mr-decode | mr-info | grep -c '^sphere'
