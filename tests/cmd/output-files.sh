# Files as they come to their names: through links, under long names, up to the limit of a size, on the disk.
[ -z "$SAN" ] || { echo "nothing is preloaded beside a sanitizer"; exit 77; }
cc -shared -fPIC -o files.so "$TOP/tests/faults/files.c" -ldl || exit
export LD_PRELOAD="$PWD/files.so" FAULTS
mkdir work
mr-make sphere -n 100 -o s.mrs
echo "-- links"
mkdir there
ln -s there/x.obj link.obj
ln -s link.obj chain.obj
ln -s round.obj round.obj
ln -s nowhere/x.obj broken.obj
for name in link chain round broken; do
	mr-export $name.obj <s.mrs
	echo "$name: exit $?"
done
find . -type l | sort
ls there
cmp there/x.obj link.obj
rm -r there *.obj
echo "-- a long name"
long=$(printf '%0251d' 0)
(cd work && mr-export "$long.obj" <../s.mrs && ls | wc -c && rm *)
echo "-- a limit"
echo old >work/old
echo mrmesh1 >work/stream
mr-make sphere -n 5000 -o big.mrs
for command in 'mr-cat -o work/stream' 'mr-export -f obj work/old' 'mr-export -f obj work/new.gz' \
	'mr-render --size 600x600 work/new.png'; do
	(ulimit -f 16; $command <big.mrs)
	echo "$command: exit $?"
done
(ulimit -f 0; mr-info --stats work/stats -o work/new <s.mrs; echo "mr-info: exit $?") 2>&1 | cat
ls work
cat work/old work/stream
echo "-- modes"
(umask 027; mr-cat s.mrs -o work/mode; stat -c %a work/mode; chmod 604 work/mode; mr-cat s.mrs -o work/mode; stat -c %a work/mode)
echo "-- a folder that cannot be written"
mr-cat s.mrs -o nowhere/x
echo "exit $?"
mr-cat s.mrs -o work
echo "exit $?"
rm work/*
echo "-- the disk"
FAULTS=sync
echo old >work/old
echo mrmesh1 >work/stream
for command in 'mr-cat -o work/stream' 'mr-export -f obj work/old' 'mr-render --size 16x16 work/new.png' 'mr-info -o work/old'; do
	$command --sync <s.mrs >out
	echo "$command --sync: exit $?"
	cat work/old work/stream
	$command <s.mrs && [ "$(cat work/old work/stream | wc -c)" -gt 12 ] && echo written
	echo old >work/old
	echo mrmesh1 >work/stream
	rm -f work/new.png
done
mr-cat --sync s.mrs >work/stdout
echo "stdout: exit $?"
mr-cat --sync s.mrs | cat >work/stdout
FAULTS= mr-cat --sync --no-history s.mrs -o work/kept && cmp s.mrs work/kept
rm work/*
