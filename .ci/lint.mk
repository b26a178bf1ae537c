# Findings of tools about the sources
#
#	make lint  clang-tidy, cppcheck and eslint: no findings; NODES=225000 as deep as clang goes by itself

# A source again when it or a header has changed; .clang-tidy and tests/lint say what is not asked.  The analyzer,
# which takes nearly
# all the time, goes NODES steps into a function: a ninth of the time of the 225000 of clang itself, which find no
# more here.  cppcheck, which takes as long as all of that, begins first.
NODES   ?= 20000
HEADERS := $(wildcard lib/*.h lib/*/*.h formats/*.h cmd/*.h)
LINT    := $(patsubst %,$(BUILD)/lint/%,$(filter-out $(if $(shell command -v $(MPICC)),,$(MPI)),$(wildcard lib/*/*.c \
		formats/*.c formats/page/*/*.c formats/web/*.c cmd/*.c)))
lint: $(BUILD)/lint/cppcheck $(BUILD)/lint/eslint $(LINT)

$(patsubst %,$(BUILD)/lint/%,$(MPI)): INCLUDE += $$(printf " -isystem %s" $$($(MPICC) --showme:incdirs))
$(BUILD)/lint/%.c: %.c .clang-tidy tests/lint/assume.h $(HEADERS) | setup
	@mkdir -p $(@D)
	$(call say,tidy   )clang-tidy --quiet --warnings-as-errors='*' \
		$(foreach word,-Xclang -analyzer-config -Xclang max-nodes=$(NODES),--extra-arg=$(word)) $< -- \
		-std=c11 $(INCLUDE) -include tests/lint/assume.h \
		2>$@.log || { cat $@.log; exit 1; } && touch $@

$(BUILD)/lint/cppcheck: tests/lint/cppcheck.txt $(HEADERS) $(LINT:$(BUILD)/lint/%=%) | setup
	@mkdir -p $@.cache
	$(call say,check  )cppcheck -q --std=c11 --enable=warning,performance,portability -Ilib -I. -Icmd \
		--inline-suppr --cppcheck-build-dir=$@.cache \
		--suppressions-list=tests/lint/cppcheck.txt --error-exitcode=1 lib formats cmd && touch $@

# Debian's modules for Node, which another Node looks for elsewhere.
$(BUILD)/lint/eslint: $(filter %.js,$(PAGE)) formats/web/mrz.js tests/lint/eslint.json | setup
	@mkdir -p $(@D)
	$(call say,eslint )NODE_PATH=/usr/share/nodejs:/usr/lib/nodejs eslint -f unix --no-eslintrc -c \
		tests/lint/eslint.json $(filter %.js,$^) && touch $@

.PHONY: lint
