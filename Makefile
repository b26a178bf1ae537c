# mr -- streaming tools for multiresolution geometry
#
#	make            the tools, in $(BUILD)/bin
#	make check      the tests, in four minutes; T=PATTERN some of them; SAN=1, SAN=thread under sanitizers
#	make bench      speed and memory beside the peers'; T=NAME one of them
#	make demo       the main job on real models: pictures and tables, in demo/, and a page of all, demo/index.html
#	make install    tools, pages, completions and library to $(DESTDIR)$(PREFIX)
#	make setup      the packages they need
#
# make help-all tells of the others, which are in .ci/*.mk: check-long, lint, matrix, fuzz, bless, uninstall, deb ...
# Only setup, check, check-X and demo install packages, others name what is missing; NOSETUP=1: none does,
# NOSETUP=: all do.

PREFIX  ?= /usr/local
DESTDIR ?=
DATA    ?= $(abspath $(wildcard ../shared/data))
BUILD   ?= $(if $(SAN),build/san$(SAN:1=),build)
CC      ?= cc
CXX     ?= c++
CFLAGS  ?= $(if $(SAN),-O1 -fsanitize=$(if $(filter thread,$(SAN)),thread,address$(,)undefined) \
		-fno-sanitize-recover=all -fno-omit-frame-pointer,-O3) -g
LDFLAGS ?= $(if $(SAN),$(if $(findstring clang,$(CC)),-fsanitize-link-c++-runtime))
VERSION := 1.0
SONAME  := libmr.so.$(basename $(VERSION))
JOBS    ?= $(shell nproc 2>/dev/null || echo 2)
NOSETUP ?= $(if $(filter-out setup check% demo,$(or $(MAKECMDGOALS),all)),1)
export NOSETUP
T       ?=

MAKEFLAGS += -j$(JOBS)

, := ,
WARN     := -Wall -Wextra -Wpedantic -Wshadow -Wconversion
INCLUDE  := -Ilib -I. -Icmd -I/usr/include/suitesparse -D_POSIX_C_SOURCE=200809L -DMR_VERSION='"$(VERSION)"'
# Hardening, which costs less than 1 % of the time of mr-import, mr-remesh and mr-solve; HARDEN= leaves it out. 
# Sanitizers check
# for themselves, _FORTIFY_SOURCE wants an optimiser, and not every compiler knows its third level.
PROBE    := echo '\#include <stdio.h>' | $(CC) -O2 -Werror -fstack-clash-protection -D_FORTIFY_SOURCE=3 -E -xc - \
		>/dev/null 2>&1
LEVEL    := $(shell $(PROBE) && echo 3)
FORTIFY  := $(if $(filter-out -O0,$(filter -O%,$(CFLAGS))),-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=$(or $(LEVEL),2))
HARDEN   := $(if $(findstring -fsanitize,$(CFLAGS)),,-fstack-protector-strong $(if $(LEVEL),-fstack-clash-protection) \
		$(FORTIFY))
SAFE     := -Wl,-z,relro,-z,now,-z,noexecstack
# The one set of objects serves the tools and both libraries; what mr.h does not declare stays inside.
SHARED   := -fPIC -fvisibility=hidden
# Where it was built does not show in what is built.
PLACE    := -fdebug-prefix-map=$(CURDIR)=.
ALL_C    := -std=c11 $(WARN) $(INCLUDE) -fno-math-errno -fno-trapping-math -ffp-contract=off -pthread $(SHARED) \
		$(PLACE) $(CFLAGS) $(HARDEN)
ALL_CXX  := -std=c++17 $(WARN) $(INCLUDE) -ffp-contract=off -pthread $(SHARED) $(PLACE) $(CFLAGS) $(HARDEN)
# Draco if it is installed, as an archive if there is one: every tool needs half a millisecond to load the other.
DRACO    := $(shell for l in -l:libdraco.a -ldraco; do \
		printf '\043include <draco/draco_features.h>\nint main() {}\n' | \
		$(CXX) -xc++ - -o /dev/null $$l 2>/dev/null && echo $$l && break; done)
LIBS     := -Wl,--as-needed -lcamd -lcholmod -lumfpack -llz4 -ltinyobjloader_double -lmeshoptimizer $(DRACO) \
		-lpng -ljpeg -ljansson -ldeflate -lz -lstdc++ -ldl -lm

# What knows MPI: `make mpi`.
MPICC   := mpicc
MPI     := lib/solve/mumps.c cmd/mpi.c
TOOLS   := $(patsubst cmd/%.c,$(BUILD)/bin/%,cmd/mr.c $(wildcard cmd/mr-*.c))
OBJECTS := $(patsubst %,$(BUILD)/%.o,$(filter-out $(MPI),$(sort $(wildcard lib/*/*.c lib/*/*.cc formats/*.c \
		formats/*.cc))))
UNITS   := $(patsubst tests/unit/%.c,$(BUILD)/tests/%,$(wildcard tests/unit/*.c))
BENCHES := $(patsubst tests/bench/%.c,$(BUILD)/bench/%,$(wildcard tests/bench/*.c))
# What the page of mr-view is made of, and where three.js and the C library for WebAssembly are.
PAGE    := $(wildcard formats/page/* formats/page/*/*)
THREE   ?= /usr/share/javascript/three
WASI    ?= /usr
RIVALS  := $(patsubst tests/bench/%.cc,$(BUILD)/bench/%,$(wildcard tests/bench/*.cc))
NEEDS   := build $(if $(filter setup check check-long check-page check-cluster coverage matrix bless units deb \
		check-deb,$(MAKECMDGOALS)),check) \
	$(if $(filter check-page picture,$(MAKECMDGOALS)),page) \
	$(if $(filter check-cluster,$(MAKECMDGOALS)),cluster) $(if $(filter mpi check-mpi,$(MAKECMDGOALS)),check mpi) \
	$(if $(filter lint,$(MAKECMDGOALS)),$(shell command -v mpicc >/dev/null && echo mpi)) \
	$(if $(filter wheel check-wheel dist-bin check-dist-bin,$(MAKECMDGOALS)),portable) \
	$(patsubst check-%,%,$(filter check-wheel lint bench deb check-deb check-arm64,$(MAKECMDGOALS)))
RUN     := PATH='$(abspath $(BUILD))/bin:$(PATH)' BUILD='$(abspath $(BUILD))' DATA='$(DATA)' SAN='$(SAN)' JOBS='$(JOBS)'

# V=1 shows the commands.
say = $(if $(V),,@echo "  $(1) $@";)

LINK = $(if $(V),,@)mkdir -p $(@D) $(if $(V),,&& echo "  link    $@") && \
	$(CC) $(ALL_C) -pie $(SAFE) $(LDFLAGS) -o $@ $^ $(LIBS)

all: $(TOOLS) $(BUILD)/web/mrz.js $(BUILD)/web/mrz.wasm

$(BUILD)/bin/mr-%: $(BUILD)/cmd/mr-%.c.o $(patsubst %,$(BUILD)/cmd/%.c.o,cmd findings help options place \
		signals) $(BUILD)/libmr.a
	$(LINK)
$(BUILD)/bin/mr: $(BUILD)/cmd/mr.c.o $(BUILD)/cmd/options.c.o $(BUILD)/libmr.a
	$(LINK)

$(BUILD)/bin/mr-view: $(BUILD)/page/page.o

$(BUILD)/page/page.o: formats/page/page.S $(BUILD)/page/page.html $(BUILD)/flags
	$(call say,compile)$(CC) -Wa,-I$(BUILD)/page -o $@ -c $<

put = -e '/^<!-- $(1) -->$$/{r $(2)' -e 'd;}'
$(BUILD)/page/page.html: formats/page/page.html formats/page/page.css formats/page/load.js $(BUILD)/page/main.gz \
		$(BUILD)/page/library.gz
	$(call say,page   )sed $(call put,style,formats/page/page.css) $(call put,load,formats/page/load.js) \
		$(call put,program,$(BUILD)/page/main.gz) $(call put,library,$(BUILD)/page/library.gz) $< >$@

$(BUILD)/page/library.gz: $(BUILD)/page/library.wasm
	@gzip -9nc $< | base64 -w 0 >$@ && echo >>$@

# The part of the library that the page runs, as WebAssembly, by the compiler that knows it.
WASM    := $(patsubst %,$(BUILD)/wasm/%.o,$(wildcard formats/page/library/*.c) $(addprefix lib/, \
	$(addsuffix .c,$(addprefix base/,ctx rotation sort) \
		$(addprefix mesh/,creases edges layers mesh scatter weld zorder) \
		$(addprefix compact/,bit_planes coder control_code lifting packed packed_fields) \
		$(addprefix edit/,correspondence deform deform_loose deform_stitch deform_system detail k_ring phong \
			pose_basis smooth turns) \
		$(addprefix op/,laplace voronoi_area) render/colormap stream/planes \
		$(addprefix solve/,cholesky conjugate_gradients dissect elimination incomplete multifrontal \
			multivector order solver sparse_apply sparse_product supernodal) \
		$(addprefix space/,bvh bvh_build contact geodesic predicates source_map surface_walk thickness) \
		$(addprefix subdivide/,displaced loop loop_limit))))
$(BUILD)/wasm/%.o: % $(BUILD)/flags | setup
	@mkdir -p $(@D)
	$(call say,compile)clang --target=wasm32-wasi --sysroot=$(WASI) -msimd128 -std=c11 \
		$(if $(findstring edit,$<)$(findstring rotation,$<),-O3,-Os) -ffunction-sections -fno-math-errno \
		-ffp-contract=off $(WARN) $(INCLUDE) -MMD -MP -c -o $@ $<
# Packed surfaces for other people's pages.
MRZ     := $(patsubst %,$(BUILD)/wasm/%.o,formats/web/mrz.c formats/page/library/system.c $(addprefix lib/, \
	$(addsuffix .c,base/ctx mesh/edges mesh/mesh $(addprefix compact/,bit_planes coder control_code lifting \
		packed packed_fields) $(addprefix subdivide/,displaced loop loop_limit))))
$(BUILD)/web/mrz.wasm: $(MRZ)
$(BUILD)/web/mrz.js: formats/web/mrz.js
	@mkdir -p $(@D)
	cp $< $@

$(BUILD)/page/library.wasm: $(WASM)
$(BUILD)/page/library.wasm $(BUILD)/web/mrz.wasm:
	@mkdir -p $(@D)
	$(call say,link   )clang --target=wasm32-wasi --sysroot=$(WASI) -nostartfiles \
		-Wl,--no-entry,--gc-sections,--strip-all,--export=malloc,--export=free \
		-nodefaultlibs -o $@ $^ -lc -lm

# One script of all modules of the page, three.js included, packed, as text.
$(BUILD)/page/main.gz: $(filter %.js,$(PAGE)) | setup
	@mkdir -p $(@D)
	$(call say,bundle )esbuild formats/page/main.js --bundle --minify --format=iife --target=es2020 --charset=utf8 \
		--alias:three=$(THREE) --log-level=warning --outfile=$(@:.gz=.js) && \
		gzip -9nc $(@:.gz=.js) | base64 -w 0 >$@ && echo >>$@

$(BUILD)/tests/%: $(BUILD)/tests/unit/%.c.o $(BUILD)/libmr.a
	@mkdir -p $(@D)
	$(call say,link   )$(CC) $(ALL_C) $(LDFLAGS) -o $@ $^ $(LIBS) -lcmocka

$(BUILD)/bench/%: $(BUILD)/tests/bench/%.c.o $(BUILD)/libmr.a
	@mkdir -p $(@D)
	$(call say,link   )$(CC) $(ALL_C) $(LDFLAGS) -o $@ $^ $(LIBS)

# The peers' templates are theirs: no warnings.  One that cannot be built is left out of the bench.
$(BUILD)/bench/%: tests/bench/%.cc $(BUILD)/flags | setup
	@mkdir -p $(@D)
	-$(call say,link   )$(CXX) -std=c++17 -O3 -DNDEBUG -w -I/usr/include/eigen3 $(INCLUDE) -pthread -o $@ $< \
		-Wl,--as-needed -lgmp -lmpfr -lcholmod -lOpenMeshCore -lm

$(BUILD)/libmr.a: $(OBJECTS)
	$(call say,archive)rm -f $@ && $(AR) qcsD $@ $^

# Threads sleep in it.
$(BUILD)/$(SONAME): $(OBJECTS)
	$(call say,link   )echo '{ global: mr_*; local: *; };' >$@.map && \
		$(CC) -shared $(ALL_C) $(SAFE) $(LDFLAGS) -Wl,-soname,$(@F) -Wl,-z,nodelete \
		-Wl,--version-script=$@.map -o $@ $^ $(LIBS)

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
ASKED := $(if $(filter check,$(MAKECMDGOALS)),$(patsubst unit/%,$(BUILD)/tests/%,$(filter unit/%,$(shell \
		BUILD='$(BUILD)' tests/run --list $(T)))))

units: $(UNITS)

help:
	@sed -n 's/^#\tmake/make/p' Makefile; echo 'others: make help-all'

help-all:
	@sed -n 's/^#\tmake/make/p' Makefile .ci/*.mk

setup:
	@CC='$(CC)' THREE='$(THREE)' WASI='$(WASI)' TRIED='$(if $(filter setup,$(MAKECMDGOALS)),,$(BUILD)/tried)' \
		.ci/setup $(NEEDS)

# Without what takes minutes in a browser, on a scheduler, of several processes: each has its target.
check: $(TOOLS) $(ASKED) $(if $(SAN),,$(BUILD)/$(SONAME))
	@$(RUN) tests/run $(or $(T),unit/ cmd/ pipe/ bad/ laws/ man/)

# What is there already is done again only by newer tools or scripts.
demo: demo/figures.txt demo/clouds.txt demo/index.html
	@echo; echo 'Page: demo/index.html, to open in a browser, its models beside it: drag the handles.' \
		'Pictures: demo/sheet.png, the edits; demo/*-scan.png, the scans; demo/frames/, an animation;' \
		'demo/textured.png and .glb. Tables: $(filter %.txt,$^)'

demo/figures.txt: $(TOOLS) examples/demo.sh examples/models.sh
	@$(RUN) examples/demo.sh demo

demo/clouds.txt: $(TOOLS) examples/reconstruct.sh examples/models.sh | demo/figures.txt
	@$(RUN) examples/reconstruct.sh demo

demo/index.html: $(BUILD)/bin/mr-view demo/figures.txt demo/clouds.txt
	@$(RUN) mr-view -q --beside --pack 0.01% $@ demo/edits/*.mrs demo/scans/*.mrs

bench: $(TOOLS) $(BENCHES) $(RIVALS)
	@$(RUN) tests/bench/run $(T)

include .ci/mpi.mk .ci/tests.mk .ci/lint.mk .ci/install.mk .ci/packages.mk .ci/pictures.mk

-include $(shell test -d $(BUILD) && find $(BUILD) \( -name deb -o -name check-deb -o -name arm64 \) -prune -o -type \
		f -name '*.d' -print)

.PHONY: all units help help-all setup check demo bench
.SECONDARY:
