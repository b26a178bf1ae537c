# That the matrix of tools and models finds wrong results is tried with tools that give them.
"$TOP/tests/matrix/run" --small one-vertex >said
code=$?
[ $code -eq 0 ] || { cat said; exit $code; }

mkdir -p false/bin
ln -s "$BUILD"/bin/mr-* false/bin
rm false/bin/mr-remesh
wrong() { # what is to be said of mr-remesh, what it is
	printf '#!/bin/sh\n%s\n' "$2" >false/bin/mr-remesh
	chmod +x false/bin/mr-remesh
	BUILD=$PWD/false "$TOP/tests/matrix/run" --small 'inside-out.obj remesh' >said 2>&1 &&
		{ echo "not found: $2"; exit 1; }
	grep -q "WRONG .*: $1" said && grep -q ' 1 wrong' said || { echo "$2:"; cat said; exit 1; }
}
wrong 'exit 139' 'kill -SEGV $$'
wrong 'exit 2' 'exit 2'
wrong 'exit 1 and 0 sentences' 'exit 1'
wrong 'exit 1 and 2 sentences' 'echo mr-remesh: no. >&2; echo mr-remesh: never. >&2; exit 1'
wrong 'exit 0 and 1 sentences' 'mr-cat; echo mr-remesh: no. >&2'
wrong 'a whole stream' 'mr-cat; echo mr-remesh: no. >&2; exit 1'
wrong 'no stream' ':'
wrong 'no stream' 'head -c 5000'
wrong 'topology' 'mr-crop -q -l base --keep above:y,0.5'
