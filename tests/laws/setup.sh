# Set-up: silent where all is there; where apt is not, it names what is missing, by the names of each system, and does
# nothing, and no more does it with NOSETUP; what is optional never makes it fail.
fail=0
"$TOP/.ci/setup" build check >out 2>&1 || { cat out; echo "setup fails where all is there"; fail=1; }
[ ! -s out ] || { cat out; echo "setup says something where nothing is to do"; fail=1; }

mkdir bin
for command in sh awk cat cut grep id mktemp rm sed touch tr ldconfig; do
	path=$(command -v $command || ls /sbin/$command) && ln -s "$path" bin/$command
done
CC=no-such-compiler PATH=$PWD/bin bin/sh "$TOP/.ci/setup" build check >out 2>&1
[ $? -eq 1 ] || { echo "setup does not fail without apt-get"; fail=1; }
for package in gcc libsuitesparse-dev libtinyobjloader-dev libcmocka-dev mandoc groff-base; do
	grep -q "^  $package " out || { echo "setup does not name $package"; fail=1; }
done
while read -r title fedora arch alpine homebrew; do
	grep -qE " $fedora +$arch +$alpine +$homebrew +$title" out ||
		{ echo "setup does not say what other systems call $title"; fail=1; }
done <<'END'
SuiteSparse suitesparse-devel suitesparse suitesparse-dev suite-sparse
Jansson jansson-devel jansson jansson-dev jansson
libpng libpng-devel libpng libpng-dev libpng
FLANN flann-devel flann - flann
END
grep -q 'TINYOBJLOADER_USE_DOUBLE' out || { echo "setup does not say how to come by tinyobjloader"; fail=1; }
[ $fail -eq 0 ] || cat out
# No commands at all.
PATH= /bin/sh "$TOP/.ci/setup" >out 2>&1 && { cat out; echo "setup goes well without commands"; fail=1; }
[ "$(wc -l <out)" -eq 1 ] && grep -q 'there is no awk on the PATH' out ||
	{ cat out; echo "setup has no sentence for an empty PATH"; fail=1; }

# With NOSETUP apt-get is a trap: by setup itself, by make, and where the examples look for models.
mkdir trap
for command in apt-get apt dpkg-deb sudo dnf apk pacman brew npm; do
	printf '#!/bin/sh\necho "$0 $*" >>"%s/sprung"\nexit 1\n' "$PWD" >trap/$command && chmod +x trap/$command
done
printf '#!/bin/sh\n' >trap/ldconfig && chmod +x trap/ldconfig
NOSETUP=1 CC=no-such-compiler PATH=$PWD/trap:$PWD/bin bin/sh "$TOP/.ci/setup" build check >out 2>&1
[ $? -eq 1 ] && grep -q 'installed unasked' out && grep -q '^  libsuitesparse-dev ' out ||
	{ cat out; echo "setup does not say what is missing with NOSETUP"; fail=1; }
PATH=$PWD/trap:$PATH make -s -C "$TOP" BUILD="$PWD/none" NOSETUP=1 setup >out 2>&1 ||
	{ cat out; echo "make NOSETUP=1 setup fails for want of OpenBLAS"; fail=1; }
grep -q '^  libopenblas0-pthread ' out ||
	{ cat out; echo "make NOSETUP=1 setup does not say that OpenBLAS is missing"; fail=1; }
PATH=$PWD/trap:$PATH make -s -C "$TOP" BUILD="$PWD/none" NOSETUP=1 THREE=/none setup >out 2>&1 &&
	{ cat out; echo "make NOSETUP=1 setup goes well without three.js"; fail=1; }
grep -q '^  libjs-three ' out || { cat out; echo "make NOSETUP=1 setup does not say that three.js is missing"; fail=1; }
mkdir models && (cd models && PATH=$PWD/../trap:$PATH NOSETUP=1 sh "$TOP/examples/models.sh" >/dev/null) ||
	{ echo "no models with NOSETUP"; fail=1; }
[ ! -s sprung ] || { cat sprung; echo "a package manager is called with NOSETUP"; fail=1; }
PATH=$PWD/trap:$PATH "$TOP/.ci/setup" build >/dev/null 2>&1
[ -s sprung ] || { echo "the trap does not work"; fail=1; }

# All is there but OpenBLAS, which no kind of user can get.
mkdir stub
stub() { # command, what it does
	printf '#!/bin/sh\n%s\n' "$2" >stub/"$1" && chmod +x stub/"$1"
}
without_blas() { # which user
	PATH=$PWD/stub:$PATH "$TOP/.ci/setup" build check >out 2>&1 ||
		{ cat out; echo "setup fails for want of OpenBLAS $1"; fail=1; }
	grep -q 'goes on without' out && grep -q '^  libopenblas0-pthread .*OpenBLAS' out ||
	    { cat out; echo "setup does not say that OpenBLAS is missing $1"; fail=1; }
}
stub ldconfig 'exit 0'
stub apt-get 'exit 100'
stub id 'echo 0'
without_blas 'as root'
stub id 'echo 1000'
stub sudo 'exit 1'
without_blas 'to whom sudo says no'
stub sudo 'exit 127'
stub apt-get 'exit 127'
without_blas 'without apt-get and sudo'
stub apt-get 'echo tried; exit 100'
stub id 'echo 0'
for time in first second; do
	TRIED=$PWD/tried PATH=$PWD/stub:$PATH "$TOP/.ci/setup" build check >$time 2>&1 ||
		{ cat $time; echo "setup fails the $time time"; fail=1; }
done
grep -q 'OpenBLAS' first && grep -q '^tried' first || { cat first; echo "setup does not try to get OpenBLAS"; fail=1; }
[ ! -s second ] || { cat second; echo "setup tries and tells again what it could not get"; fail=1; }
CC=no-such-compiler PATH=$PWD/stub:$PWD/bin bin/sh "$TOP/.ci/setup" build >out 2>&1 &&
    { cat out; echo "setup does not fail where something is missing that is required"; fail=1; }
exit $fail
