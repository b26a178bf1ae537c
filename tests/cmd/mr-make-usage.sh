# Wrong command lines: exit 2, nothing on stdout; too much: exit 1.
for args in '' nonsense 'cube torus' '-n x cube' '-n -5 cube' '--noise 1q cube' '--points 1.5 cube' '--genus 1000000000 boxes'; do
	mr-make $args >out 2>err
	echo "$args: exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
done
mr-make -n 900000000 plane >out 2>err
echo "exit $?: $(head -n 1 err)"
