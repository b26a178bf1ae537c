# What install writes is the same whatever the umask, and uninstall takes that away and nothing else; completions of
# bash, zsh and fish have the options of --help, and are made without a tool that runs; a tarball of the sources gives
# itself again.
[ -z "$SAN" ] || { echo "a build with sanitizers is not installed"; exit 77; }
fail=0
bad() {
	echo "$*"
	fail=1
}
run() {
	make -s -C "$TOP" BUILD="$BUILD" PREFIX=/usr "$@" >make.log 2>&1 || { cat make.log; exit 1; }
}
listing() { # folder: names, modes, bytes
	(cd "$1" && find . ! -type d -printf '%p %m %l\n' | LC_ALL=C sort && find . -type f -exec cksum {} + |
		LC_ALL=C sort)
}

(umask 077 && run DESTDIR="$PWD/tight" install) || exit
(umask 002 && run DESTDIR="$PWD/wide" install) || exit
listing tight >one
listing wide >two
diff one two || bad "install heeds the umask"

# Files of others stand beside every one of ours, under names like ours.
run DESTDIR="$PWD/shared" PREFIX=/opt/mr LIBDIR=/opt/mr/lib/x86 install
for folder in $(find shared -type d); do
	for name in mr-other _mr-other mr-solve.bak libmr.so.0 mr.pc.in; do
		echo other >"$folder/$name"
	done
done
listing shared >with
run DESTDIR="$PWD/shared" PREFIX=/opt/mr LIBDIR=/opt/mr/lib/x86 uninstall
left=$(find shared ! -type d | grep -vE '/(mr-other|_mr-other|mr-solve.bak|libmr.so.0|mr.pc.in)$')
[ -z "$left" ] || bad "uninstall leaves $left"
for folder in $(find shared -type d); do
	[ "$(cat "$folder"/mr-other "$folder"/_mr-other "$folder"/mr-solve.bak \
		"$folder"/libmr.so.0 "$folder"/mr.pc.in | grep -c other)" -eq 5 ] ||
	    bad "uninstall takes what is not its own from $folder"
done

# In a copy of the sources without a build no tool can run.
mkdir bare && (cd "$TOP" && cp -R .ci cmd "$OLDPWD/bare")
bare/.ci/completions "$PWD/made" || bad "completions are not made"
for tool in "$BUILD"/bin/mr-*; do
	name=${tool##*/}
	"$tool" --help | grep -E '^ +-' | sed 's/  *[^ -].*//' | grep -oE -- '(^| )--?[a-zA-Z][a-z-]*' | tr -d ' ' |
		sort -u >said
	grep -oE -- '( -s [a-zA-Z]| -l [a-z-]+)' "made/fish/$name.fish" | sed 's/ -s /-/; s/ -l /--/' | sort -u >fish
	diff said fish || bad "$name: fish completes other options than --help has"
	grep -oE -- "[{,'*]--?[a-zA-Z][a-z-]*" "made/zsh/_$name" | tr -d "{,'*" | sort -u >zsh
	diff said zsh || bad "$name: zsh completes other options than --help has"
	grep -- '--help' "made/bash/$name" | grep -oE -- '--[a-z][a-z-]*' | sort -u >bash
	grep -- -- said | diff - bash || bad "$name: bash completes other options than --help has"
	for shell in bash zsh fish; do
		command -v $shell >/dev/null || continue
		$shell -n made/$shell/*"$name"* || bad "$shell does not read what is for $name"
	done
done
if command -v bash >/dev/null; then
	answer=$(bash -c '. made/bash/mr-solve; COMP_WORDS=(mr-solve --solver = m)
		COMP_CWORD=3; _mr_solve; echo "${COMPREPLY[@]}"
		COMP_WORDS=(mr-solve --verb); COMP_CWORD=1; _mr_solve; echo "${COMPREPLY[@]}"')
	[ "$answer" = "multigrid
--verbose" ] || bad "bash completes $answer"
fi
if command -v fish >/dev/null; then
	answer=$(HOME=$PWD fish -c \
		'. made/fish/mr-solve.fish; complete -C "mr-solve -s mu"; complete -C "mr-solve --flat"' | cut -f1)
	[ "$answer" = "multigrid
--flatten" ] || bad "fish completes $answer"
fi
if command -v zsh >/dev/null; then
	# What zsh would show is asked of a terminal of its own.
	cat >ask.zsh <<-'END'
		zmodload zsh/zpty
		zpty shell zsh -f -i
		zpty -w shell 'PS1=; unsetopt zle_bracketed_paste; fpath=(made/zsh $fpath); autoload -Uz compinit' \
			'; compinit -D -u; LISTMAX=0'
		zpty -w shell 'bindkey "^I" complete-word; print READY'
		zpty -r shell line '*READY*READY*'
		zpty -w -n shell $'mr-solve --solver=mu\t --flat\t\n'
		zpty -r shell line '*--flatten*'
		print -r -- "$line"
		zpty -d shell
	END
	TERM=dumb timeout 30 zsh -f ask.zsh >answer 2>&1
	grep -q -- '--solver=multigrid .*--flatten' answer || { cat -v answer; bad "zsh does not complete"; }
fi

# Twice the same tarball; and what it holds makes it again, without git.
mkdir once again
run dist BUILD="$PWD/once"
(umask 077 && export TZ=Asia/Tokyo && run dist BUILD="$PWD/again") || exit
tarball=$(cd once && echo *.tar.gz)
cmp "once/$tarball" "again/$tarball" || bad "make dist gives other bytes the second time"
tar -xzf "once/$tarball"
TOP=$PWD/${tarball%.tar.gz}
rm "again/$tarball"
run dist BUILD="$PWD/again"
cmp "once/$tarball" "again/$tarball" || bad "the tarball of a tarball is another one"
exit $fail
