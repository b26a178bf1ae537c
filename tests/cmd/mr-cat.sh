# Streams one after another: every frame, as it was; packed and unpacked again, the same bytes.
same() { # what, file, file
	cmp "$2" "$3" && echo "ok $1" || echo "bad $1"
}
mr-make sphere -n 500 -o sphere.mrs
mr-make torus -n 500 -o torus.mrs

mr-cat --no-history sphere.mrs >copy.mrs
same 'a copy' sphere.mrs copy.mrs
mr-cat --no-history <sphere.mrs | mr-cat --no-history - >copy.mrs
same 'through pipes' sphere.mrs copy.mrs

mr-cat --no-history sphere.mrs torus.mrs >both.mrs
cat sphere.mrs torus.mrs | mr-cat --no-history >copy.mrs
same 'cat makes a stream, too' both.mrs copy.mrs
strings -n 8 both.mrs | grep '^key '
cat torus.mrs | mr-cat --no-history sphere.mrs - >copy.mrs
same '- is stdin' both.mrs copy.mrs

mr-cat -z --no-history both.mrs >packed.mrs
[ $(($(wc -c <packed.mrs) * 3)) -lt $(($(wc -c <both.mrs) * 2)) ] && echo 'ok packed is smaller' || echo 'bad packed'
mr-cat --no-history packed.mrs >copy.mrs
same 'packed ones pass' packed.mrs copy.mrs
mr-cat --unpack --no-history packed.mrs >copy.mrs
same 'unpacked' both.mrs copy.mrs
mr-cat --pack --no-history copy.mrs >again.mrs
same 'packed again' packed.mrs again.mrs
mr-cat -u --no-history both.mrs >copy.mrs
same 'raw ones pass' both.mrs copy.mrs

mr-cat sphere.mrs | strings | grep '^mr 1.0: '
