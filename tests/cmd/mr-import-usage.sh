# Wrong command lines: exit 2, nothing on stdout.
printf 'v 0 0 0\n' >a.obj
for args in '-f nonsense a.obj' '--weld=-1 a.obj' '--weld=x a.obj' '--nonsense a.obj'; do
	mr-import $args
	echo "exit $?" >&2
done
