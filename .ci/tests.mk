# Tests beside `make check`
#
#	make check-long     the tests that make check samples, in full: an hour; T=PATTERN some of them
#	make check-page     the tests of the page of mr-view in Chromium, which it installs
#	make check-cluster  the batch of examples/ on Slurm, installed for it, on virtual nodes; MODELS=N models
#	make matrix         every tool on every model of DATA and on uglies; T=PATTERN some of them
#	make compare-peers  20 scans and models from raw to a GLB with levels, beside Open3D: $(BUILD)/peers/index.html
#	make coverage       what the tests run of lib, formats and cmd: lines and branches; T=PATTERN some of them
#	make fuzz           readers and tools under libFuzzer; TIME=SECONDS each, T=PATTERN some, SEED=N the same again
#	make bless          the command tests' outputs become the expected ones; T=PATTERN

check-long: $(TOOLS)
	@LONG=1 LIMIT=14400 $(RUN) tests/run $(or $(T),bad/ pipe/ cmd/mr-encode cmd/mr-view)

check-page: $(TOOLS)
	@$(RUN) tests/run $(or $(T),page/)

check-cluster: $(TOOLS)
	@rm -f $(BUILD)/cluster.txt
	@$(RUN) MODELS='$(MODELS)' LIMIT=14400 tests/run $(or $(T),cluster/)
	@cat $(BUILD)/cluster.txt 2>/dev/null || true

matrix: $(TOOLS)
	@mkdir -p $(BUILD)/matrix && cd $(BUILD)/matrix && $(RUN) $(CURDIR)/tests/matrix/run '$(T)'

compare-peers:
	@$(MAKE) --no-print-directory bench T=peers

# In a build of its own, by gcc's counters, which every process adds to the same files.
COVERED := $(BUILD)/coverage
coverage:
	@$(MAKE) --no-print-directory BUILD='$(COVERED)' CC=gcc CXX=g++ \
		CFLAGS='-O1 -g --coverage -fprofile-update=prefer-atomic' HARDEN= all units
	@find $(COVERED) -name '*.gcda' -exec rm -f {} +
	-@$(RUN) BUILD='$(abspath $(COVERED))' LIMIT=1200 tests/run $(T)
	@tests/coverage '$(COVERED)'

# In a build of its own; clang's libFuzzer watches the whole library.
FUZZ  := $(BUILD)/fuzz
TIME  ?= 10
FUZZY := -g -O1 -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
fuzz: $(TOOLS)
	@$(MAKE) --no-print-directory BUILD='$(FUZZ)' CC=clang CXX=clang++ CFLAGS='$(FUZZY)' \
		$(patsubst tests/fuzz/%.c,$(FUZZ)/fuzz/%,$(wildcard tests/fuzz/*.c))
	@$(RUN) BUILD='$(abspath $(FUZZ))' TOOLS='$(abspath $(BUILD))/bin' TIME='$(TIME)' SEED='$(SEED)' \
		tests/fuzz/run $(T)

$(BUILD)/fuzz/%: $(BUILD)/tests/fuzz/%.c.o $(BUILD)/libmr.a
	@mkdir -p $(@D)
	$(call say,link   )$(CXX) -pthread -fsanitize=fuzzer,address,undefined -o $@ $^ $(LIBS)

bless: $(TOOLS)
	@$(RUN) tests/run --bless $(T)

.PHONY: check-long check-page check-cluster coverage matrix compare-peers fuzz bless
