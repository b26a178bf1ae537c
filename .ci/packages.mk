# Packages
#
#	make dist         the sources as a tarball, mr-VERSION.tar.gz, in $(BUILD)
#	make dist-bin     tools, library and what they load, for Linux with this glibc or a later one, as a tarball in
#	                  $(BUILD), with recipes for conda, Homebrew and a container; URL=FOLDER where it will be
#	make check-dist-bin  unpacks and tries it elsewhere, and in a new system; as root
#	make wheel        the Python package, tools and their libraries inside, in $(BUILD)/wheel
#	make check-wheel  tries it in an environment of its own
#	make deb          Debian packages of tools, library and headers, by .debian, in $(BUILD)/deb
#	make check-deb    builds them twice, elsewhere: the same bytes; tries them in a new system; as root
#	make check-arm64  builds for arm64 and compares what the tools give, under qemu, with these; as root

# The tracked files as they stand, or, where there is no git, all; in one order, as of the last commit: the same bytes
# anywhere.
DIST   := mr-$(VERSION)
EPOCH   = $(or $(SOURCE_DATE_EPOCH),$(shell git log -1 --format=%ct 2>/dev/null || date -r Makefile +%s))
SOURCES = $(if $(wildcard .git),git ls-files,find . -type f ! -path './build/*' ! -path './demo/*' | sed 's,^\./,,')
dist:
	@mkdir -p $(BUILD)
	$(call say,pack   )$(SOURCES) | LC_ALL=C sort | tar -cf $(BUILD)/$(DIST).tar --no-recursion --mtime=@$(EPOCH) \
		--owner=0 --group=0 --numeric-owner \
		--mode=u+rw,go+rX,go-w,a-s --format=ustar --transform='s,^,$(DIST)/,' -T - && gzip -9nf \
		$(BUILD)/$(DIST).tar

# What is installed, made to run wherever it is put; the last of its files is the licence.
MOVABLE  := $(abspath $(BUILD))/portable
PORTABLE := $(BUILD)/portable/share/doc/mr/LICENSE
$(PORTABLE): $(TOOLS) $(BUILD)/$(SONAME) .ci/portable $(wildcard man/*) | setup
	$(call say,gather )rm -rf $(MOVABLE)
	@env -u MAKEFLAGS -u MFLAGS $(MAKE) -s --no-print-directory install $(MAKEOVERRIDES) PREFIX='$(MOVABLE)' \
		DESTDIR= >/dev/null
	@.ci/portable $(MOVABLE)
	@cp LICENSE $@

# The recipes of other systems' packages are filled in; URL is the folder where the tarball will be.
URL    ?= file://$(abspath $(BUILD))
BINARY := $(DIST)-linux-$(shell uname -m)
dist-bin: $(PORTABLE) | setup
	$(call say,pack   )tar -cf $(BUILD)/$(BINARY).tar --sort=name --mtime=@$(EPOCH) --owner=0 --group=0 \
		--numeric-owner --transform='flags=r;s,^\.,$(BINARY),' -C $(BUILD)/portable . && gzip -9nf \
		$(BUILD)/$(BINARY).tar
	@cd $(BUILD) && sha256sum $(BINARY).tar.gz >$(BINARY).tar.gz.sha256
	@mkdir -p $(BUILD)/packaging && for file in .ci/packaging/*; do sed "s,@URL@,$(URL),; s,@BINARY@,$(BINARY),; \
		s,@VERSION@,$(VERSION),; s,@SHA256@,$$(cut -c1-64 $(BUILD)/$(BINARY).tar.gz.sha256),; \
		s,@GLIBC@,$$(cat $(MOVABLE)/bin/* $(MOVABLE)/lib/mr/* | grep -ao 'GLIBC_2\.[0-9]*' | sort -V | \
		tail -n 1 | sed 's/.*\.//')," $$file >$(BUILD)/packaging/$${file##*/} || exit; done
	@ls $(BUILD)/$(BINARY).tar.gz $(BUILD)/packaging/*

check-dist-bin: dist-bin
	@$(RUN) tests/dist-bin '$(abspath $(BUILD))/$(BINARY).tar.gz' '$(abspath $(BUILD))/check-dist-bin'

wheel: $(PORTABLE) | setup
	@rm -rf $(BUILD)/wheel && mkdir -p $(BUILD)/wheel
	@SOURCE_DATE_EPOCH=$(EPOCH) python3 lib/python/build_wheel.py $(VERSION) $(BUILD)/portable . $(BUILD)/wheel

check-wheel: wheel
	@SOURCE_DATE_EPOCH=$(EPOCH) $(RUN) tests/wheel $(VERSION) '$(abspath $(BUILD))' \
		'$(abspath $(BUILD))/check-wheel'

# Packages are built from the tarball, in which .debian has the name that Debian asks for.
deb: dist | setup
	rm -rf $(BUILD)/deb && mkdir -p $(BUILD)/deb && tar -xzf $(BUILD)/$(DIST).tar.gz -C $(BUILD)/deb
	cp $(BUILD)/$(DIST).tar.gz $(BUILD)/deb/mr-tools_$(VERSION).orig.tar.gz
	cp -pR $(BUILD)/deb/$(DIST)/.debian $(BUILD)/deb/$(DIST)/debian && chmod -R u=rwX,go=rX \
		$(BUILD)/deb/$(DIST)/debian
	cd $(BUILD)/deb/$(DIST) && env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL -u BUILD \
		DEB_BUILD_OPTIONS='parallel=$(JOBS) $(DEB_BUILD_OPTIONS)' \
		dpkg-buildpackage -us -uc $(DEBFLAGS) >../build.log 2>&1 || { tail -n 30 ../build.log; exit 1; }
	@ls $(BUILD)/deb/*.deb

check-deb: dist $(TOOLS) $(BUILD)/$(SONAME) | setup
	@$(RUN) tests/deb '$(abspath $(BUILD))/$(DIST).tar.gz' '$(abspath $(BUILD))/check-deb'

check-arm64: $(TOOLS) | setup
	@$(RUN) tests/arm64 '$(abspath $(BUILD))/arm64'

.PHONY: dist dist-bin check-dist-bin wheel check-wheel deb check-deb check-arm64
