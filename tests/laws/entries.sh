# Running out of memory leads to the public function that was called: each that takes memory begins by MR_ENTER, or
# MR_ON_COPY, which does.  Three take none from the arena but through others.
cd "$TOP" || exit
none='mr_frame_get mr_reader_open mr_writer_open'
tr '\n\t' '  ' <lib/mr.h | grep -o 'MR_API mr_status mr_[a-z_]*( *mr_ctx' | sed 's/.* \(mr_[a-z_]*\)(.*/\1/' >names
[ "$(wc -l <names)" -ge 40 ] || { echo "only $(wc -l <names) functions found"; exit 1; }
bad=0
while read -r name; do
	case " $none " in *" $name "*) continue ;; esac
	cat lib/*/*.c formats/*.c |
		awk -v name="$name(" 'index($0, name) == 1 { on = 1 } on { print } on && /^}/ { exit }' |
	    grep -qE '	(MR_ENTER|MR_ON_COPY)\(' || { echo "$name: no MR_ENTER"; bad=1; }
done <names
rm -f names
exit $bad
