# Wrong command lines: exit 2, a sentence, nothing on stdout.
for args in '-L -1' '-r 0' '-r nan' '-n x' '-n 5x' '-a 1e9' '--gravity 9' '--feature 181' '--feature sharp' '--vertices -1' '--faces x' '--adaptive 1%%' '--nothing' '-L'; do
	mr-make sphere -n 100 | mr-remesh $args >out 2>err
	echo "$args: $? $(wc -c <out) $(head -n 1 err)"
done
