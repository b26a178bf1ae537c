# mr -- streaming tools for multiresolution geometry
#
#	make            the tools, in $(BUILD)/bin
#	make help       this list
#	make setup      the packages they need; the other targets see to that by themselves
#	make check      the tests; T=PATTERN some of them; SAN=1 under the address and undefined-behaviour sanitizers
#	make check SAN=thread T=threads the tools that have threads under the thread sanitizer
#	make check-long the tests of faults in full: an hour
#	make check-page the tests of the page of mr-view in Chromium, which it installs
#	make check-cluster the batch of examples/ on Slurm, which it installs, on virtual nodes; MODELS=N how many models
#	make mpi        mr-solve-mpi, which divides the factor among processes, by MUMPS, which it installs
#	make check-mpi  its tests
#	make coverage   what the tests run of lib, formats and cmd: lines and branches; T=PATTERN some of them
#	make lint       clang-tidy, cppcheck and eslint over the sources: no findings; NODES=225000 as deep as clang goes by itself
#	make matrix     every tool on every model of DATA and on uglies; T=PATTERN some of them
#	make fuzz       the readers and the tools' work under libFuzzer; TIME=SECONDS each, T=PATTERN some of them, SEED=N the same again
#	make bless      the command tests' outputs become the expected ones; T=PATTERN
#	make demo       the main job on real models: pictures and tables, in demo/, and a page of all, demo/index.html
#	make bench      speed and memory beside the peers'
#	make table1     the paper's comparison of solvers, as text and picture, in $(BUILD)/table1
#	make readme     the generated parts of README.md
#	make picture    examples/page.png, the picture of the page in README.md, by Chromium, which it installs
#	make install    tools, pages, completions and library to $(DESTDIR)$(PREFIX)
#	make uninstall  takes them away again, and nothing else
#	make completions  those of bash, zsh and fish, in $(BUILD)/completions
#	make dist       the sources as a tarball, mr-VERSION.tar.gz, in $(BUILD)
#	make deb        Debian packages of tools, library and headers, by .debian, in $(BUILD)/deb
#	make check-deb  builds them twice, elsewhere and otherwise, which gives the same bytes, and tries them in a new system; as root
#	make check-arm64  builds the tools for arm64 and compares what they give, under qemu, with what these do; as root
#	make clean      removes build/
#
#	NOSETUP=1       no target installs a package: what is missing is named

PREFIX  ?= /usr/local
DESTDIR ?=
DATA    ?= $(abspath $(wildcard ../shared/data))
BUILD   ?= $(if $(SAN),build/san$(SAN:1=),build)
CC      ?= cc
CXX     ?= c++
CFLAGS  ?= $(if $(SAN),-O1 -fsanitize=$(if $(filter thread,$(SAN)),thread,address$(,)undefined) -fno-sanitize-recover=all -fno-omit-frame-pointer,-O3) -g
LDFLAGS ?= $(if $(SAN),$(if $(findstring clang,$(CC)),-fsanitize-link-c++-runtime))
VERSION := 1.0
SONAME  := libmr.so.$(basename $(VERSION))
JOBS    ?= $(shell nproc 2>/dev/null || echo 2)
NOSETUP ?=
export NOSETUP
T       ?=

MAKEFLAGS += -j$(JOBS)

, := ,
WARN     := -Wall -Wextra -Wpedantic -Wshadow -Wconversion
INCLUDE  := -Ilib -I. -Icmd -I/usr/include/suitesparse -D_POSIX_C_SOURCE=200809L -DMR_VERSION='"$(VERSION)"'
# Hardening, which costs less than 1 % of the time of mr-import, mr-remesh and mr-solve; HARDEN= leaves it out.  Sanitizers check
# for themselves, _FORTIFY_SOURCE wants an optimiser, and not every compiler knows its third level.
PROBE    := echo '\#include <stdio.h>' | $(CC) -O2 -Werror -fstack-clash-protection -D_FORTIFY_SOURCE=3 -E -xc - >/dev/null 2>&1
LEVEL    := $(shell $(PROBE) && echo 3)
FORTIFY  := $(if $(filter-out -O0,$(filter -O%,$(CFLAGS))),-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=$(or $(LEVEL),2))
HARDEN   := $(if $(findstring -fsanitize,$(CFLAGS)),,-fstack-protector-strong $(if $(LEVEL),-fstack-clash-protection) $(FORTIFY))
SAFE     := -Wl,-z,relro,-z,now,-z,noexecstack
# The one set of objects serves the tools and both libraries; what mr.h does not declare stays inside.
SHARED   := -fPIC -fvisibility=hidden
# Where it was built does not show in what is built.
PLACE    := -fdebug-prefix-map=$(CURDIR)=.
ALL_C    := -std=c11 $(WARN) $(INCLUDE) -fno-math-errno -ffp-contract=off -pthread $(SHARED) $(PLACE) $(CFLAGS) $(HARDEN)
ALL_CXX  := -std=c++17 $(WARN) $(INCLUDE) -ffp-contract=off -pthread $(SHARED) $(PLACE) $(CFLAGS) $(HARDEN)
LIBS     := -Wl,--as-needed -lcholmod -lumfpack -llz4 -ltinyobjloader_double -lpng -ljpeg -ljansson -lz -lstdc++ -ldl -lm

# What knows MPI: `make mpi`.
MPI     := lib/solve/mumps.c cmd/mpi.c
TOOLS   := $(patsubst cmd/%.c,$(BUILD)/bin/%,$(wildcard cmd/mr-*.c))
OBJECTS := $(patsubst %,$(BUILD)/%.o,$(filter-out $(MPI),$(sort $(wildcard lib/*/*.c lib/*/*.cc formats/*.c formats/*.cc))))
UNITS   := $(patsubst tests/unit/%.c,$(BUILD)/tests/%,$(wildcard tests/unit/*.c))
BENCHES := $(patsubst tests/bench/%.c,$(BUILD)/bench/%,$(wildcard tests/bench/*.c))
# What the page of mr-view is made of, and where three.js and the C library for WebAssembly are.
PAGE    := $(wildcard formats/page/* formats/page/*/*)
THREE   ?= /usr/share/javascript/three
WASI    ?= /usr
RIVALS  := $(patsubst tests/bench/%.cc,$(BUILD)/bench/%,$(wildcard tests/bench/*.cc))
NEEDS   := build $(if $(filter setup check check-long check-page check-cluster coverage matrix bless units deb check-deb,$(MAKECMDGOALS)),check) \
	$(if $(filter check-page picture,$(MAKECMDGOALS)),page) \
	$(if $(filter check-cluster,$(MAKECMDGOALS)),cluster) $(if $(filter mpi check-mpi,$(MAKECMDGOALS)),check mpi) \
	$(if $(filter lint,$(MAKECMDGOALS)),$(shell command -v mpicc >/dev/null && echo mpi)) \
	$(patsubst check-%,%,$(filter lint bench deb check-deb check-arm64,$(MAKECMDGOALS)))
RUN     := PATH='$(abspath $(BUILD))/bin:$(PATH)' BUILD='$(abspath $(BUILD))' DATA='$(DATA)' SAN='$(SAN)' JOBS='$(JOBS)'

# V=1 shows the commands.
say = $(if $(V),,@echo "  $(1) $@";)

all: $(TOOLS)

$(BUILD)/bin/%: $(BUILD)/cmd/%.c.o $(patsubst %,$(BUILD)/cmd/%.c.o,cmd figures findings options place signals terminal) $(BUILD)/libmr.a
	@mkdir -p $(@D)
	$(call say,link   )$(CC) $(ALL_C) -pie $(SAFE) $(LDFLAGS) -o $@ $^ $(LIBS)

# Alone it may start a program: cmd/open.c.
$(BUILD)/bin/mr-view: $(BUILD)/page/page.o $(BUILD)/cmd/open.c.o

# mr-solve over MPI: MUMPS in the place of CHOLMOD, and what mpi.c says of terminals.
mpi: $(BUILD)/mpi/mr-solve-mpi
MPICC = mpicc
$(patsubst %,$(BUILD)/%.o,$(MPI)): ALL_C += $$($(MPICC) --showme:compile)
$(patsubst %,$(BUILD)/%.o,$(MPI)): | setup
$(BUILD)/cmd/mpi-solve.c.o: cmd/mr-solve.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,compile)$(CC) $(ALL_C) -Dmain=mr_solve_main -MMD -MP -c -o $@ $<
$(BUILD)/mpi/mr-solve-mpi: $(patsubst %,$(BUILD)/%.o,$(MPI) $(patsubst %,cmd/%.c,mpi-solve cmd figures findings options place signals)) $(BUILD)/libmr.a
	@mkdir -p $(@D)
	$(call say,link   )$(CC) $(ALL_C) -pie $(SAFE) $(LDFLAGS) -o $@ $^ $(LIBS) -ldmumps $$($(MPICC) --showme:link)

$(BUILD)/page/page.o: formats/page/page.S $(BUILD)/page/page.html $(BUILD)/flags
	$(call say,compile)$(CC) -Wa,-I$(BUILD)/page -o $@ -c $<

put = -e '/^<!-- $(1) -->$$/{r $(2)' -e 'd;}'
$(BUILD)/page/page.html: formats/page/page.html formats/page/page.css formats/page/load.js $(BUILD)/page/main.gz $(BUILD)/page/worker.gz
	$(call say,page   )sed $(call put,style,formats/page/page.css) $(call put,load,formats/page/load.js) \
		$(call put,program,$(BUILD)/page/main.gz) $(call put,worker,$(BUILD)/page/worker.gz) $< >$@

# The part of the library that the page runs, as WebAssembly, by the compiler that knows it.
WASM    := $(patsubst %,$(BUILD)/wasm/%.o,$(wildcard formats/page/library/*.c) lib/base/ctx.c lib/base/rotation.c lib/base/sort.c \
	$(addprefix lib/mesh/,edges.c mesh.c fold.c zorder.c) $(addprefix lib/edit/,phong.c pose_basis.c) $(addprefix lib/space/,bvh.c bvh_build.c bvh_labels.c geodesic.c predicates.c self_intersect.c suspects.c) lib/mesh/alike.c lib/render/colormap.c lib/stream/planes.c $(addprefix lib/subdivide/,displaced.c loop.c loop_limit.c wavelet.c))
$(BUILD)/wasm/%.o: % $(BUILD)/flags | setup
	@mkdir -p $(@D)
	$(call say,compile)clang --target=wasm32-wasi --sysroot=$(WASI) -msimd128 -std=c11 $(if $(findstring library,$<),-O3,-Os) -ffunction-sections -fno-math-errno -ffp-contract=off \
		$(WARN) $(INCLUDE) -MMD -MP -c -o $@ $<
$(BUILD)/page/library.wasm: $(WASM)
	@mkdir -p $(@D)
	$(call say,link   )clang --target=wasm32-wasi --sysroot=$(WASI) -nostartfiles -Wl,--no-entry,--gc-sections,--strip-all,--export=malloc,--export=free \
		-nodefaultlibs -o $@ $^ -lc -lm

# The tools' own tables of options, by which the page reads histories.
$(BUILD)/page/options.js: formats/page/paint/options.awk cmd/cmd.c $(wildcard cmd/mr-*.c)
	@mkdir -p $(@D)
	$(call say,options)awk -f $^ >$@

# Of each program of the page one script of all its modules, three.js included, packed, as text.
$(BUILD)/page/%.gz: $(filter %.js,$(PAGE)) $(BUILD)/page/options.js $(BUILD)/page/library.wasm | setup
	@mkdir -p $(@D)
	$(call say,bundle )esbuild formats/page/$*.js --bundle --minify --format=iife --target=es2020 --charset=utf8 \
		--alias:three=$(THREE) --alias:library.wasm=$(abspath $(BUILD))/page/library.wasm \
		--alias:tool-options=$(abspath $(BUILD))/page/options.js --loader:.wasm=binary --log-level=warning \
		--outfile=$(@:.gz=.js) && gzip -9nc $(@:.gz=.js) | base64 -w 0 >$@ && echo >>$@

$(BUILD)/tests/%: $(BUILD)/tests/unit/%.c.o $(BUILD)/libmr.a
	@mkdir -p $(@D)
	$(call say,link   )$(CC) $(ALL_C) $(LDFLAGS) -o $@ $^ $(LIBS) -lcmocka

$(BUILD)/bench/%: $(BUILD)/tests/bench/%.c.o $(BUILD)/libmr.a
	@mkdir -p $(@D)
	$(call say,link   )$(CC) $(ALL_C) $(LDFLAGS) -o $@ $^ $(LIBS)

# The peers' templates are theirs: no warnings.  One that cannot be built is left out of the bench.
$(BUILD)/bench/%: tests/bench/%.cc $(BUILD)/flags | setup
	@mkdir -p $(@D)
	-$(call say,link   )$(CXX) -std=c++17 -O3 -DNDEBUG -w -I/usr/include/eigen3 $(INCLUDE) -pthread -o $@ $< -Wl,--as-needed -lgmp -lmpfr -lcholmod -lOpenMeshCore -lm

$(BUILD)/libmr.a: $(OBJECTS)
	$(call say,archive)rm -f $@ && $(AR) qcsD $@ $^

$(BUILD)/$(SONAME): $(OBJECTS)
	$(call say,link   )echo '{ global: mr_*; local: *; };' >$@.map && \
		$(CC) -shared $(ALL_C) $(SAFE) $(LDFLAGS) -Wl,-soname,$(@F) -Wl,--version-script=$@.map -o $@ $^ $(LIBS)

$(BUILD)/%.c.o: %.c $(BUILD)/flags | setup
	@mkdir -p $(@D)
	$(call say,compile)$(CC) $(ALL_C) -MMD -MP -MT '$$(BUILD)/$<.o' -c -o $@ $<

$(BUILD)/%.cc.o: %.cc $(BUILD)/flags | setup
	@mkdir -p $(@D)
	$(call say,compile)$(CXX) $(ALL_CXX) -MMD -MP -MT '$$(BUILD)/$<.o' -c -o $@ $<

# Other compilers or flags rebuild everything.
FLAGS := $(CC) $(CXX) $(ALL_C) $(SAFE) $(LDFLAGS)
ifneq ($(file <$(BUILD)/flags),$(FLAGS))
$(shell mkdir -p $(BUILD))$(file >$(BUILD)/flags,$(FLAGS))
endif

# Those unit tests that T asks for.
ASKED := $(if $(filter check,$(MAKECMDGOALS)),$(patsubst unit/%,$(BUILD)/tests/%,$(filter unit/%,$(shell BUILD='$(BUILD)' tests/run --list $(T)))))

units: $(UNITS)

help:
	@sed -n 's/^#\tmake/make/p' Makefile

setup:
	@CC='$(CC)' THREE='$(THREE)' WASI='$(WASI)' TRIED='$(if $(filter setup,$(MAKECMDGOALS)),,$(BUILD)/tried)' .ci/setup $(NEEDS)

# Without what takes minutes in a browser, on a scheduler, of several processes: each has its target.
check: $(TOOLS) $(ASKED) $(if $(SAN),,$(BUILD)/$(SONAME))
	@$(RUN) tests/run $(or $(T),unit/ cmd/ pipe/ bad/ laws/ man/)

check-long: $(TOOLS)
	@LONG=1 LIMIT=14400 $(RUN) tests/run $(or $(T),bad/)

check-page: $(TOOLS)
	@$(RUN) tests/run $(or $(T),page/)

check-cluster: $(TOOLS)
	@rm -f $(BUILD)/cluster.txt
	@$(RUN) MODELS='$(MODELS)' LIMIT=14400 tests/run $(or $(T),cluster/)
	@cat $(BUILD)/cluster.txt 2>/dev/null || true

check-mpi: $(TOOLS) mpi
	@$(RUN) tests/run $(or $(T),mpi/)

matrix: $(TOOLS)
	@mkdir -p $(BUILD)/matrix && cd $(BUILD)/matrix && $(RUN) $(CURDIR)/tests/matrix/run '$(T)'

# In a build of its own, by gcc's counters, which every process adds to the same files.
COVERED := $(BUILD)/coverage
coverage:
	@$(MAKE) --no-print-directory BUILD='$(COVERED)' CC=gcc CXX=g++ CFLAGS='-O1 -g --coverage -fprofile-update=prefer-atomic' HARDEN= all units
	@find $(COVERED) -name '*.gcda' -exec rm -f {} +
	-@$(RUN) BUILD='$(abspath $(COVERED))' LIMIT=1200 tests/run $(T)
	@tests/coverage '$(COVERED)'

# A source again when it or a header has changed; .clang-tidy and tests/lint say what is not asked.  The analyzer, which takes nearly
# all the time, goes NODES steps into a function: a ninth of the time of the 225000 of clang itself, which find no
# more here.  cppcheck, which takes as long as all of that, begins first.
NODES   ?= 20000
HEADERS := $(wildcard lib/*.h lib/*/*.h formats/*.h cmd/*.h)
LINT    := $(patsubst %,$(BUILD)/lint/%,$(filter-out $(if $(shell command -v $(MPICC)),,$(MPI)),$(wildcard lib/*/*.c formats/*.c formats/page/*/*.c cmd/*.c)))
lint: $(BUILD)/lint/cppcheck $(BUILD)/lint/eslint $(LINT)

$(patsubst %,$(BUILD)/lint/%,$(MPI)): INCLUDE += $$(printf " -isystem %s" $$($(MPICC) --showme:incdirs))
$(BUILD)/lint/%.c: %.c .clang-tidy tests/lint/assume.h $(HEADERS) | setup
	@mkdir -p $(@D)
	$(call say,tidy   )clang-tidy --quiet --warnings-as-errors='*' \
		$(foreach word,-Xclang -analyzer-config -Xclang max-nodes=$(NODES),--extra-arg=$(word)) $< -- -std=c11 $(INCLUDE) -include tests/lint/assume.h \
		2>$@.log || { cat $@.log; exit 1; } && touch $@

$(BUILD)/lint/cppcheck: tests/lint/cppcheck.txt $(HEADERS) $(LINT:$(BUILD)/lint/%=%) | setup
	@mkdir -p $@.cache
	$(call say,check  )cppcheck -q --std=c11 --enable=warning,performance,portability -Ilib -I. -Icmd --inline-suppr --cppcheck-build-dir=$@.cache \
		--suppressions-list=tests/lint/cppcheck.txt --error-exitcode=1 lib formats cmd && touch $@

# Debian's modules for Node, which another Node looks for elsewhere.
$(BUILD)/lint/eslint: $(filter %.js,$(PAGE)) tests/lint/eslint.json | setup
	@mkdir -p $(@D)
	$(call say,eslint )NODE_PATH=/usr/share/nodejs:/usr/lib/nodejs eslint -f unix --no-eslintrc -c tests/lint/eslint.json $(filter %.js,$^) && touch $@

# In a build of its own; clang's libFuzzer watches the whole library.
FUZZ  := $(BUILD)/fuzz
TIME  ?= 10
FUZZY := -g -O1 -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
fuzz: $(TOOLS)
	@$(MAKE) --no-print-directory BUILD='$(FUZZ)' CC=clang CXX=clang++ CFLAGS='$(FUZZY)' $(patsubst tests/fuzz/%.c,$(FUZZ)/fuzz/%,$(wildcard tests/fuzz/*.c))
	@$(RUN) BUILD='$(abspath $(FUZZ))' TOOLS='$(abspath $(BUILD))/bin' TIME='$(TIME)' SEED='$(SEED)' tests/fuzz/run $(T)

$(BUILD)/fuzz/%: $(BUILD)/tests/fuzz/%.c.o $(BUILD)/libmr.a
	@mkdir -p $(@D)
	$(call say,link   )$(CXX) -pthread -fsanitize=fuzzer,address,undefined -o $@ $^ $(LIBS)

bless: $(TOOLS)
	@$(RUN) tests/run --bless $(T)

# What is there already is done again only by newer tools or scripts.
demo: demo/figures.txt demo/clouds.txt demo/index.html
	@echo; echo 'Page: demo/index.html, to open in a browser: drag the handles. Pictures: demo/sheet.png, the edits; demo/*-scan.png, the scans; demo/frames/, an animation; demo/textured.png and .glb. Tables: $(filter %.txt,$^)'

demo/figures.txt: $(TOOLS) examples/demo.sh examples/models.sh
	@$(RUN) examples/demo.sh demo

demo/clouds.txt: $(TOOLS) examples/reconstruct.sh examples/models.sh | demo/figures.txt
	@$(RUN) examples/reconstruct.sh demo

demo/index.html: $(BUILD)/bin/mr-view demo/figures.txt demo/clouds.txt
	@$(RUN) mr-view -q $@ demo/edits/*.mrs demo/scans/*.mrs

bench: $(TOOLS) $(BENCHES) $(RIVALS)
	@$(RUN) tests/bench/run $(T)

table1: $(TOOLS) $(BUILD)/bench/plot
	@$(RUN) PATH='$(abspath $(BUILD))/bin:$(abspath $(BUILD))/bench:$(PATH)' sh tests/bench/table1.sh '$(BUILD)/table1'

readme:
	@tests/readme >$(BUILD)/README.md && cat $(BUILD)/README.md >README.md
	@tests/findings >$(BUILD)/findings.7 && cat $(BUILD)/findings.7 >man/mr-findings.7

picture: demo/index.html
	@PYTHONDONTWRITEBYTECODE=1 python3 tests/page/picture.py $< examples/page.png

LIBDIR  ?= $(PREFIX)/lib
BASHDIR ?= $(PREFIX)/share/bash-completion/completions
ZSHDIR  ?= $(PREFIX)/share/zsh/site-functions
FISHDIR ?= $(PREFIX)/share/fish/vendor_completions.d
define PC
prefix=$(PREFIX)
libdir=$(LIBDIR)
includedir=$(PREFIX)/include

Name: mr
Description: multiresolution geometry: editing with detail, displaced subdivision surfaces
Version: $(VERSION)
Libs: -L$${libdir} -lmr
Libs.private: $(filter -l%,$(LIBS)) -pthread
Cflags: -I$${includedir}
endef
export PC

completions:
	@.ci/completions '$(abspath $(BUILD))/completions'

# One mode for every file, whatever the umask says.
TO    := $(DESTDIR)$(PREFIX)
NAMES := $(notdir $(TOOLS))
install: $(TOOLS) $(BUILD)/$(SONAME) completions
	install -d $(addprefix $(TO)/,bin include share/man/man1 share/man/man5 share/man/man7) $(addprefix $(DESTDIR),$(BASHDIR) $(ZSHDIR) $(FISHDIR) $(LIBDIR)/pkgconfig)
	install $(TOOLS) $(wildcard $(BUILD)/mpi/mr-solve-mpi) $(TO)/bin
	for n in 1 5 7; do install -m 644 man/*.$$n $(TO)/share/man/man$$n || exit; done
	install -m 644 $(BUILD)/completions/bash/* $(DESTDIR)$(BASHDIR)
	install -m 644 $(BUILD)/completions/zsh/* $(DESTDIR)$(ZSHDIR)
	install -m 644 $(BUILD)/completions/fish/* $(DESTDIR)$(FISHDIR)
	install -m 644 lib/mr.h $(TO)/include
	install -m 644 $(BUILD)/libmr.a $(BUILD)/$(SONAME) $(DESTDIR)$(LIBDIR)
	ln -sf $(SONAME) $(DESTDIR)$(LIBDIR)/libmr.so
	echo "$$PC" >$(BUILD)/mr.pc && install -m 644 $(BUILD)/mr.pc $(DESTDIR)$(LIBDIR)/pkgconfig

uninstall:
	rm -f $(addprefix $(TO)/bin/,$(NAMES) mr-solve-mpi) $(foreach n,1 5 7,$(addprefix $(TO)/share/man/man$n/,$(notdir $(wildcard man/*.$n))))
	rm -f $(addprefix $(DESTDIR)$(BASHDIR)/,$(NAMES)) $(addprefix $(DESTDIR)$(ZSHDIR)/_,$(NAMES)) $(patsubst %,$(DESTDIR)$(FISHDIR)/%.fish,$(NAMES))
	rm -f $(TO)/include/mr.h $(addprefix $(DESTDIR)$(LIBDIR)/,libmr.a $(SONAME) libmr.so pkgconfig/mr.pc)

# The tracked files as they stand, or, where there is no git, all; in one order, as of the last commit: the same bytes anywhere.
DIST   := mr-$(VERSION)
EPOCH   = $(or $(SOURCE_DATE_EPOCH),$(shell git log -1 --format=%ct 2>/dev/null || date -r Makefile +%s))
SOURCES = $(if $(wildcard .git),git ls-files,find . -type f ! -path './build/*' ! -path './demo/*' | sed 's,^\./,,')
dist:
	@mkdir -p $(BUILD)
	$(call say,pack   )$(SOURCES) | LC_ALL=C sort | tar -cf $(BUILD)/$(DIST).tar --no-recursion --mtime=@$(EPOCH) --owner=0 --group=0 --numeric-owner \
		--mode=u+rw,go+rX,go-w,a-s --format=ustar --transform='s,^,$(DIST)/,' -T - && gzip -9nf $(BUILD)/$(DIST).tar

# Packages are built from the tarball, in which .debian has the name that Debian asks for.
deb: dist | setup
	rm -rf $(BUILD)/deb && mkdir -p $(BUILD)/deb && tar -xzf $(BUILD)/$(DIST).tar.gz -C $(BUILD)/deb
	cp $(BUILD)/$(DIST).tar.gz $(BUILD)/deb/mr-tools_$(VERSION).orig.tar.gz
	cp -pR $(BUILD)/deb/$(DIST)/.debian $(BUILD)/deb/$(DIST)/debian && chmod -R u=rwX,go=rX $(BUILD)/deb/$(DIST)/debian
	cd $(BUILD)/deb/$(DIST) && env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL -u BUILD DEB_BUILD_OPTIONS='parallel=$(JOBS) $(DEB_BUILD_OPTIONS)' \
		dpkg-buildpackage -us -uc $(DEBFLAGS) >../build.log 2>&1 || { tail -n 30 ../build.log; exit 1; }
	@ls $(BUILD)/deb/*.deb

check-deb: dist $(TOOLS) $(BUILD)/$(SONAME) | setup
	@$(RUN) tests/deb '$(abspath $(BUILD))/$(DIST).tar.gz' '$(abspath $(BUILD))/check-deb'

check-arm64: $(TOOLS) | setup
	@$(RUN) tests/arm64 '$(abspath $(BUILD))/arm64'

clean:
	rm -rf build

-include $(shell test -d $(BUILD) && find $(BUILD) \( -name deb -o -name check-deb -o -name arm64 \) -prune -o -type f -name '*.d' -print)

.PHONY: all units help setup check check-long check-page check-cluster check-mpi mpi coverage lint matrix fuzz bless demo bench table1 readme picture install uninstall completions dist deb check-deb check-arm64 clean
.SECONDARY:
