# Set-up: silent where all is there; where apt is not, it names what is missing and does nothing; what is optional never
# makes it fail.
fail=0
"$TOP/.ci/setup" build check >out 2>&1 || { cat out; echo "setup fails where all is there"; fail=1; }
[ ! -s out ] || { cat out; echo "setup says something where nothing is to do"; fail=1; }

mkdir bin
for command in sh awk cat cut grep id mktemp rm sed tr ldconfig; do
	path=$(command -v $command || ls /sbin/$command) && ln -s "$path" bin/$command
done
CC=no-such-compiler PATH=$PWD/bin bin/sh "$TOP/.ci/setup" build check >out 2>&1
[ $? -eq 1 ] || { echo "setup does not fail without apt-get"; fail=1; }
for package in gcc libsuitesparse-dev libtinyobjloader-dev libcmocka-dev mandoc groff-base; do
	grep -q "$package: " out || { echo "setup does not name $package"; fail=1; }
done
[ $fail -eq 0 ] || cat out

# All is there but OpenBLAS, which no kind of user can get.
mkdir stub
stub() { # command, what it does
	printf '#!/bin/sh\n%s\n' "$2" >stub/"$1" && chmod +x stub/"$1"
}
without_blas() { # which user
	PATH=$PWD/stub:$PATH "$TOP/.ci/setup" build check >out 2>&1 || { cat out; echo "setup fails for want of OpenBLAS $1"; fail=1; }
	grep -q 'goes on without' out && grep -q 'libopenblas0-pthread: OpenBLAS' out ||
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
	TRIED=$PWD/tried PATH=$PWD/stub:$PATH "$TOP/.ci/setup" build check >$time 2>&1 || { cat $time; echo "setup fails the $time time"; fail=1; }
done
grep -q 'OpenBLAS' first && grep -q '^tried' first || { cat first; echo "setup does not try to get OpenBLAS"; fail=1; }
[ ! -s second ] || { cat second; echo "setup tries and tells again what it could not get"; fail=1; }
CC=no-such-compiler PATH=$PWD/stub:$PWD/bin bin/sh "$TOP/.ci/setup" build >out 2>&1 &&
    { cat out; echo "setup does not fail where something is missing that is required"; fail=1; }
exit $fail
