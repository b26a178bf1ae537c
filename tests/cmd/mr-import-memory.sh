# A few bytes that inflate to more than there is memory: a sentence, and no more memory than allowed.
[ -z "$SAN" ] || { echo "a sanitizer needs address space"; exit 77; }
head -c 100000000 /dev/zero | tr '\0' '\n' | gzip >part.gz
{ cat part.gz part.gz part.gz part.gz; echo 1 2 3 | gzip; } >bomb.gz
attempt() {
	(ulimit -v 350000 && "$@" 2>err >out)
	echo "exit $?, $(wc -c <out) bytes: $(sed 's/[0-9][0-9]* bytes/# bytes/' err)"
}
attempt mr-import -f xyz bomb.gz
cat bomb.gz | attempt mr-import -f xyz
yes 1 2 3 | attempt mr-import -f xyz
read -r n <<END
$(tr -cd 0-9 <err)
END
[ "$n" -lt 140000000 ] && echo 'of what there is a third, so that there is room for the points'

# What has no sign of its format is read all the same.
mr-make sphere -n 200000 | mr-export s.off
sed 1d s.off | mr-import --no-history -f off - | mr-export t.off
cmp s.off t.off && echo same
