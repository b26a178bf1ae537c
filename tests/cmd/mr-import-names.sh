# Names: in the stream they are UTF-8 without control characters, for which _ stands.
printf 'mtllib m\351.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nusemtl rot\351\nf 1 2 3\nusemtl rot\350\nf 2 4 3\nusemtl a\tb\nf 1 2 4\nusemtl 50%% \303\251 %%E9\nf 1 3 4\n' >model.obj
mr-import model.obj | mr-export -f obj - | grep -e usemtl -e mtllib

echo 'a name may end in a backslash'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\no back\\\ng a\\b\nusemtl c:\\\nf 1 2 3\n' >back.obj
mr-import -q back.obj | mr-export -q -f obj - | cmp - back.obj && echo same

echo 'what is called alike stays apart, but where files have names alone, which is said'
solid() { # name, z
	printf 'solid%s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 %s\nvertex 1 0 %s\nvertex 0 1 %s\nendloop\nendfacet\nendsolid\n' "$1" "$2" "$2" "$2"
}
{ solid ' a' 0; solid ' a' 1; solid '' 2; solid ' default' 3; } >alike.stl
mr-import alike.stl | mr-export -f stl-ascii - | grep '^solid' | cat -A
mr-import alike.stl | mr-split 2>&1 >parts.mrs && mr-cat --append parts.mrs | mr-export -f stl-ascii - | grep -c '^solid'

echo 'a long name'
for end in RED BLUE; do printf 'usemtl %03000d%s\nf 1 2 3\n' 0 $end; done | { printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n'; cat; } >long.obj
mr-import long.obj | mr-export -f obj - | cmp - long.obj && echo same
