# Beginnings and levels of packed surfaces.
mr-make torus -n 8000 | mr-simplify -q --to control -n 200 | mr-fit -q | mr-sample -q -n 4 -o surface.mrs

echo 'bytes: no more; the beginning of a file is what --bytes of both gives'
mr-pack -e 0.02% surface.mrs a.mrz
mr-pack -n 800 surface.mrs b.mrz
wc -c <b.mrz
head -c 800 a.mrz | mr-unpack -o cut.mrs
mr-unpack --bytes 800 a.mrz -o asked.mrs
for f in cut asked; do mr-cat --no-history $f.mrs 2>/dev/null | mr-decode -q | mr-export -f ply - | cksum; done

echo 'levels'
for j in 0 2 4; do mr-unpack --level $j a.mrz | mr-decode -q | mr-info | grep 'mesh: '; done
mr-unpack --each --level 3 a.mrz | mr-decode -q | mr-info | grep "mesh: "
mr-unpack --level 5 a.mrz >out
echo "exit $?, $(wc -c <out) bytes"
