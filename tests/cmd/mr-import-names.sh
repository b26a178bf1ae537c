# Names: in the stream they are UTF-8 without control characters, for which _ stands.
printf 'mtllib m\351.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nusemtl rot\351\nf 1 2 3\nusemtl rot\350\nf 2 4 3\nusemtl a\tb\nf 1 2 4\nusemtl 50%% \303\251 %%E9\nf 1 3 4\n' >model.obj
mr-import model.obj | mr-export -f obj - | grep -e usemtl -e mtllib

echo '-- of UTF-16, whole and half characters'
python3 - <<'END'
text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl F\u00fc\u00dfe\nf 1 2 3\nusemtl F\u00e4\u00dfe\nf 3 2 1\nusemtl \U0001f600 \ud83d x\nf 2 1 3\nusemtl \ude00\ud83d\nf 2 1 3\n"
for name in "utf-16-le", "utf-16-be":
    open(name + ".obj", "wb").write(("\ufeff" + text).encode(name, "surrogatepass"))
END
mr-import utf-16-le.obj | mr-export -f obj - | tee little.obj | grep usemtl
mr-import utf-16-be.obj | mr-export -f obj - | cmp - little.obj && echo same

echo 'a backslash at the end of a name is no continued line'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\no back\\ \ng a\\b\nusemtl c:\\ \nf 1 2 3\n' >back.obj
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
