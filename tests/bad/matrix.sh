# Every tool on models that none is glad of: a result that keeps what its page promises, or one sentence.  make matrix does so
# with real models, too.  That wrong results are found is tried with tools that give them.
JOBS=1 "$TOP/tests/matrix/run" --small >said
code=$?
cat said
[ $code -eq 0 ] || exit $code

mkdir -p false/bin
ln -s "$BUILD"/bin/mr-* false/bin
rm false/bin/mr-remesh
wrong() { # what is to be said of mr-remesh, what it is
	printf '#!/bin/sh\n%s\n' "$2" >false/bin/mr-remesh
	chmod +x false/bin/mr-remesh
	BUILD=$PWD/false "$TOP/tests/matrix/run" --small 'inside-out.obj remesh-rough' >said 2>&1 && { echo "not found: $2"; exit 1; }
	grep -q "WRONG .*: $1" said && grep -q ' 1 wrong' said || { echo "$2:"; cat said; exit 1; }
}
wrong 'exit 139' 'kill -SEGV $$'
wrong 'exit 2' 'exit 2'
wrong 'exit 1 and 0 sentences' 'exit 1'
wrong 'exit 1 and 2 sentences' 'echo mr-remesh: no. >&2; echo mr-remesh: never. >&2; exit 1'
wrong 'exit 0 and 1 sentences' 'mr-cat; echo mr-remesh: no. >&2'
wrong 'a whole stream' 'mr-cat; echo mr-remesh: no. >&2; exit 1'
wrong 'no stream' ':'
wrong 'no stream' 'mr-smooth | head -c 5000'
wrong 'no faces in base' 'mr-cat'
wrong 'topology' 'mr-smooth | mr-crop -q -l base --keep above:y,0.5'
