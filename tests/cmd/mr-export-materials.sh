# Files of materials: a # in names and behind them, text as OBJ may be, and what is not in them is said once.
model() { # names of materials, a face each
	printf 'mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n'
	for name; do
		printf 'usemtl %s\nf 1 2 3\n' "$name"
	done
}
colors() {
	mr-import model.obj | mr-export model.glb
	grep -a -o '"baseColorFactor":\[[01].[01],[01].[01],[01].[01]\|"name":"[^"]*"' model.glb
}
echo '-- a # belongs to the name, or begins a comment'
model 'Material #25' 'Material #26' 'A  # red' 'B' 'tex #1' >model.obj
mr-make plane -n 9 | mr-render -s 16x16 'a #1.png'
cp 'a #1.png' b.png
printf '# all\nnewmtl Material #26\nKd 0 1 0\nnewmtl Material #25\nKd 1 0 0\nnewmtl Material\nKd 0 0 0\nnewmtl A\nKd 0 0 1 # blue\nnewmtl B # one\nKd 1 1 0\nnewmtl tex #1\nmap_Kd a #1.png\n' >m.mtl
colors
sed -i 's/a #1/b/;s/png/& # a picture/' m.mtl
colors | grep png

echo '-- what is no picture'
printf 'newmtl B\nmap_Kd -s 2 2 2 -o 0 0.5 -mm 0 1 text.png\n' >m.mtl && echo text >text.png
model B >model.obj
colors

echo '-- with a mark'
model red blue >model.obj
printf '\357\273\277newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n' >m.mtl
colors

echo '-- what is not there' >&2
model red green blue yellow >model.obj
printf 'newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n' >m.mtl
colors
for i in 1 2 3; do
	sed -i "1i mtllib no$i.mtl" model.obj
done
colors
printf 'newmtl red\n\0' >m.mtl
mr-import -q model.obj | mr-export model.glb

echo '-- transparency and light are kept' >&2
model red green blue >model.obj
cat >m.mtl <<'MTL'
newmtl red
d 0.25
Tr 1
Ke 1 0 0
Ka 0 0 0
Ns 100
newmtl green
Tr 0.5
map_bump b.png
newmtl blue
Tr 1
Ke 0 0 0
MTL
mr-import model.obj | mr-export model.glb
grep -a -o '"baseColorFactor":\[[^]]*\]\|"alphaMode":"[A-Z]*"\|"emissiveFactor":\[[^]]*\]' model.glb

echo '-- a colour that is none, two descriptions of one, in a file that is named twice' >&2
printf 'newmtl red\nKd spectral red.rfl\nnewmtl green\nKd 1 0 0\nmap_Kd b.png\nnewmtl green\nKd 0 1 0\n' >m.mtl
sed -i 's/^mtllib.*/&\n&/' model.obj
mr-import model.obj | mr-export --materials . model.glb
grep -a -o '"baseColorFactor":\[[^]]*\]\|"baseColorTexture"' model.glb
