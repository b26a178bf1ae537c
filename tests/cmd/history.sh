# The history of a frame: what was typed, of very many words the first ones, and so in little memory.
[ -z "$SAN" ] || { echo "a sanitizer takes all there is of addresses"; exit 77; }
shown() {
	mr-info --json | grep -o '"history":\["[^]]*' | cut -c13-
}
mr-make sphere -n 12 | mr-export m.obj
mr-import m.obj | mr-smooth -t 1 --verbose 2>notes | mr-transform --translate '1,0,0' --layer base | shown
mr-import m.obj $(yes 'm.obj' | head -n 19999) >all.mrs
shown <all.mrs | uniq -c | sed 's/\(m\.obj \)\{5,\}/m.obj many times /'
(ulimit -v 1000000; mr-import m.obj $(yes 'm.obj' | head -n 19999) | cmp - all.mrs)
echo "little memory: exit $?"
echo "a list of a page:"
vertices=$(yes -- '--fixed all' | head -n 2000)
mr-import m.obj | mr-select $vertices --free all | shown | sed 's/\(--fixed all \)\{5,\}/--fixed all many times /'
mr-import m.obj | mr-select --free all $vertices | shown | wc -c
