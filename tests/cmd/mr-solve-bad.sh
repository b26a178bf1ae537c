# Wrong command lines: exit 2 and no output; problems that have no answer: one sentence, exit 1.
mr-make sphere -n 500 | mr-smooth -t 1 -o base.mrs
mr-select --free above:z,0.5 --handle 0=above:z,0.9 base.mrs -o s.mrs
for wrong in '-k 0' '-k 4' '-s qr' '--areas all' '--tol nan' '--unsymmetric -s cholesky' '--rotations none' '--arap -1' '--arap 1001' '--arap 2 --basis'; do
	mr-solve $wrong s.mrs >out 2>err
	echo "$wrong: exit $?, $(wc -c <out) bytes"
	head -n 1 err
done
try() { # standard input through mr-solve
	mr-solve "$@" >out 2>err
	echo "exit $?: $(cat err)"
}
echo '-- no base'
mr-make sphere -n 100 | try
echo '-- no regions'
try base.mrs
echo '-- regions of the mesh, and none of the control mesh'
mr-make sphere -n 500 | mr-simplify --to control -n 60 -o both.mrs
mr-select --free above:z,0.5 --handle 0=above:z,0.9 both.mrs -o on-mesh.mrs
try on-mesh.mrs
mr-pose --scale 2 on-mesh.mrs | try
mr-pose -l control --scale 2 on-mesh.mrs 2>&1 >out
mr-select -l control --free above:z,0.5 --handle 0=above:z,0.9 both.mrs | mr-pose --scale 2 | try
echo '-- all fixed'
mr-select --fixed all base.mrs | try --flatten
echo '-- all free'
mr-select --free all base.mrs | try --flatten
echo '-- handles, but never solved: the surface is at rest as it is'
mr-pose --translate 0,0,1 s.mrs | try
echo '-- a basis, but handles already'
mr-solve s.mrs | mr-pose | try --basis
echo '-- a basis without a handle'
mr-select --reset --free above:z,0.5 base.mrs | try --basis
echo '-- a handle too small for the base'
mr-make sphere -n 500 | mr-remesh -r 6 | mr-select --free above:z,0.5 --handle 3=rings:100,0 | try
mr-make sphere -n 100 | mr-export -f off - | awk 'NR == 2 { n = ++$1 } { print } n && NR == n + 1 { print "0 0 9" }' | mr-import - |
	mr-smooth -t 0 | mr-select --free all --fixed below:z,0.05 --handle 0=sphere:0,0,9,0.1 | try
echo '-- a handle that no vertex has'
mr-solve s.mrs | mr-pose --translate 0,0,1 | mr-select --reset --free above:z,0.5 | try
echo '-- regions without a map, parts without a constraint'
cat >two.off <<'END'
OFF
9 8 0
0 0 0
1 0 0
1 1 0
0 1 0
0.5 0.5 0.3
5 0 0
6 0 0
5 1 0
5 0 1
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
3 5 7 6
3 5 6 8
3 6 7 8
3 7 5 8
END
mr-import two.off | mr-smooth -t 0 | mr-select --free 'box:4,-1,-1,9,9,9' --free 'sphere:0.5,0.5,0.3,0.1' -o two.mrs
mr-solve -v --flatten -k 1 two.mrs 2>&1 >out.mrs
mr-export -f off -l base - <out.mrs | sed -n '7,11p'
echo '-- the same, posed: parts follow, or stay; handles alone move all there is'
mr-select --reset --free all --fixed below:z,0.01+sphere:0.5,0.5,0,0.8 --handle 0=sphere:0.5,0.5,0.3,0.1 two.mrs | mr-pose --translate 0,0,1 -o up.mrs
for apart in '' --apart; do
	mr-solve $apart -k 1 up.mrs 2>&1 >out.mrs
	echo "exit $?"
	mr-export -f off -l base - <out.mrs | sed -n '7,11p'
done
mr-select --reset --handle 0=all two.mrs | mr-pose --translate 0,0,1 | mr-solve | mr-export -f off -l base - | sed -n '3,4p'
echo '-- flattening after a pose'
mr-pose s.mrs | try --flatten
echo '-- a layer that is no base'
mr-select --reset --free above:z,0.5 base.mrs | try -l mesh
echo '-- a handle that goes beyond all numbers'
mr-pose --translate 1e308,1e308,1e308 s.mrs | try
