# Wrong command lines: exit 2, a sentence, nothing on stdout.
for args in '-m' '-m cubic' '-n x' '-n -1' '-n 2000000' '--step 1.1' '--step nan' '--fairness -1' \
	'--step 0.5' '-m local --fairness 1' '--nothing'; do
	mr-make sphere -n 100 | mr-fit $args >out 2>err
	echo "$args: $? $(wc -c <out) $(head -n 1 err)"
done
