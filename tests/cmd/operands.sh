# Operands as users try them: inputs, then the output; options misspelt; shares in percent.
mr-make sphere -n 200 s.mrs
mr-export s.mrs s.ply && mr-export s.ply copy.obj && mr-export s.mrs s.mrs 'two-%d.off' && mr-export -f off s.mrs - | head -n 2
mr-render -s 30x30 s.mrs a.png && mr-render -s 30x30 b.png s.ply && cmp a.png b.png
mr-view s.mrs a.html && mr-view b.html s.mrs && cmp a.html b.html
mr-render -s 30x30 - c.png <s.mrs && cmp a.png c.png
ls
echo '-- a source writes the stream that its last operand names, and reads none'
mr-import s.ply copy.obj both.mrs --points
mr-info both.mrs | grep -e history -e points:
mr-import s.ply -o out.mrs both.mrs
mr-import both.mrs
echo '-- what is not told'
mr-export s.ply s.mrs
mr-export -f ply s.ply s.mrs
mr-export -f off - - <s.mrs | head -n 2
mr-export - - two.ply <s.mrs
mr-render s.mrs s.ply
mr-smooth s.mrs absent.mrs >out.mrs
echo '-- options that are nearly right'
for option in --raito --fase=3 -ratio -faces=3 --rat --error-max --nonsense --N -Z -no-history; do
	mr-simplify $option s.mrs 2>&1 >/dev/null | head -n 1
done
echo '-- shares'
for share in 0.25 25% 2.5e1%; do
	mr-simplify -r $share s.mrs | mr-info | grep faces
done
for share in 101% -1% % 1%% 10%x; do
	mr-simplify -r $share s.mrs 2>&1 >/dev/null | head -n 1
done
mr-select --free above:z,75% s.mrs | mr-cat --no-history -o a.mrs && mr-select --free above:z,0.75 s.mrs | mr-cat --no-history -o b.mrs
mr-select --free above:z,175% s.mrs 2>&1 | head -n 1
