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
printf 'ply\nformat ascii 1.0\ncomment mtllib lib\\\ncomment object back\\\ncomment group a\\b\ncomment material c:\\\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\nproperty uint object\nproperty uint group\nproperty uint material\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 0 0 0\n3 2 1 3 0 0 0\n' >back.ply
mr-import -q back.ply | mr-export -q back.obj && grep -n '\\' back.obj
mr-import -q back.obj | mr-export -q -f obj - | cmp - back.obj && mr-import -q back.obj | mr-export -f ply-ascii - | grep '^comment\|^3'

echo 'what is called alike stays apart, but where files have names alone, which is said'
sed 's/object back./object back/; s/element face/comment object back\nelement face/; s/^3 2 1 3 0/3 2 1 3 1/' back.ply >alike.ply
mr-import -q alike.ply -o alike.mrs && mr-export -q -i alike.mrs -f ply-ascii - | grep '^comment object\|^3'
solid() { # name, z
	printf 'solid%s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 %s\nvertex 1 0 %s\nvertex 0 1 %s\nendloop\nendfacet\nendsolid\n' "$1" "$2" "$2" "$2"
}
{ solid ' a' 0; solid ' a' 1; solid '' 2; solid ' default' 3; } >alike.stl
mr-import alike.stl | mr-export -f stl-ascii - | grep '^solid' | cat -A
mr-import -q alike.ply | mr-export alike.obj 2>&1 | grep names
mr-import alike.stl | mr-split 2>&1 >parts.mrs && mr-cat --append parts.mrs | mr-export -f stl-ascii - | grep -c '^solid'
mr-cat --append alike.mrs alike.mrs 2>&1 >twice.mrs

echo 'a long name'
for end in RED BLUE; do printf 'usemtl %03000d%s\nf 1 2 3\n' 0 $end; done | { printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n'; cat; } >long.obj
for format in obj ply; do
	mr-import long.obj | mr-export -f $format long-out.$format && mr-import long-out.$format | mr-export -f obj - | cmp - long.obj && echo same
done
