# Set-up: silent where all is there; where apt is not, it names what is missing and does nothing.
fail=0
"$TOP/.ci/setup" build check >out 2>&1 || { cat out; echo "setup fails where all is there"; fail=1; }
[ ! -s out ] || { cat out; echo "setup says something where nothing is to do"; fail=1; }

mkdir bin
for command in sh awk cat cut grep id mktemp rm sed tr ldconfig; do
	path=$(command -v $command || ls /sbin/$command) && ln -s "$path" bin/$command
done
CC=no-such-compiler PATH=$PWD/bin bin/sh "$TOP/.ci/setup" build check >out 2>&1
[ $? -eq 1 ] || { echo "setup does not fail without apt-get"; fail=1; }
for package in gcc libsuitesparse-dev libtinyobjloader-dev libcmocka-dev mandoc; do
	grep -q "$package: " out || { echo "setup does not name $package"; fail=1; }
done
[ $fail -eq 0 ] || cat out
exit $fail
