# Wrong command lines: exit 2, nothing on stdout.
printf 'v 0 0 0\n' >a.obj
for args in '-f nonsense a.obj' '--weld=-1 a.obj' '--weld=x a.obj' '--nonsense a.obj'; do
	mr-import $args
	echo "exit $?" >&2
done
echo 'a model stays a model' >&2
cp a.obj model
for args in 'a.obj -o a.obj' 'a.obj -o b.STL.gz' '-f obj model -o model'; do
	mr-import $args
	echo "exit $?" >&2
done
cmp a.obj model
ls
