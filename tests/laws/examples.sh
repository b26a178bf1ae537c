# Every script of examples/ runs, on a small model, in an empty directory.
fail=0
for script in "$TOP"/examples/*.sh; do
	name=$(basename "$script" .sh)
	mkdir "$name"
	(cd "$name" && MR_SMALL=2000 sh -e "$script" >../out 2>../err) || { echo "$name fails:"; cat out err; fail=1; }
	[ -n "$(find "$name" -type f -size +0)" ] || { echo "$name made nothing"; fail=1; }
	[ -z "$(find "$name" -name work)" ] || { echo "$name leaves its intermediate streams"; fail=1; }
done
for script in edit animate; do # a name that is mistyped is no file to be made
	(sh -e "$TOP/examples/$script.sh" nowhere.off 2>err) && { echo "$script makes something of nothing"; fail=1; }
	[ ! -e nowhere.off ] || { echo "$script makes the model that is not there"; fail=1; }
done
exit $fail
