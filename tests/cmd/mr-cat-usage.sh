# Wrong command lines: exit 2, nothing on stdout.
mr-make sphere -n 100 -o s.mrs
for wrong in '-z -u' --merge '--merge s.mrs' '--append --merge s.mrs s.mrs' --nonsense; do
	mr-cat $wrong <s.mrs >out 2>err
	echo "$wrong: exit $?, $(wc -c <out) bytes"
	head -n 1 err
done
