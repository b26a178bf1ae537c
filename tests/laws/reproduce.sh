# What is built does not show where, when, in which language, by how many at a time, or under which umask: objects and
# the page of mr-view have the same bytes from another folder.  make check-deb compares all tools, libraries and
# packages.
[ -z "$SAN" ] || { echo "a sanitizer keeps the names of files"; exit 77; }
things='lib/stream/frame.c.o cmd/mr-cat.c.o formats/ply.c.o page/page.html'
fail=0
build() { # folder, jobs
	mkdir -p "$1" && (cd "$TOP" && cp -R Makefile .ci lib cmd formats "$OLDPWD/$1") || exit
	make -s -C "$1" BUILD=out JOBS="$2" $(for thing in $things; do echo "out/$thing"; done) >log 2>&1 ||
		{ cat log; exit 1; }
}
(umask 022 && export TZ=UTC LC_ALL=C && build one 1) || exit
(umask 077 && export TZ=Asia/Tokyo LC_ALL=C.UTF-8 HOME=/none && build another/and/deeper 2) || exit
for thing in $things; do
	cmp "one/out/$thing" "another/and/deeper/out/$thing" ||
		{ echo "$thing shows where or when it was built"; fail=1; }
done
exit $fail
