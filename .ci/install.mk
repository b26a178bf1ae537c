# To the system and away
#
#	make install      tools, pages, completions and library to $(DESTDIR)$(PREFIX)
#	make uninstall    takes them away again, and nothing else
#	make completions  those of bash, zsh and fish, in $(BUILD)/completions
#	make clean        removes build/

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
install: $(TOOLS) $(BUILD)/$(SONAME) $(BUILD)/web/mrz.js $(BUILD)/web/mrz.wasm completions
	install -d $(addprefix $(TO)/,bin include share/mr/web share/man/man1 share/man/man5 share/man/man7) \
		$(addprefix $(DESTDIR),$(BASHDIR) $(ZSHDIR) $(FISHDIR) $(LIBDIR)/pkgconfig)
	install $(TOOLS) $(wildcard $(BUILD)/mpi/mr-solve-mpi) $(TO)/bin
	for n in 1 5 7; do install -m 644 man/*.$$n $(TO)/share/man/man$$n || exit; done
	install -m 644 $(BUILD)/completions/bash/* $(DESTDIR)$(BASHDIR)
	install -m 644 $(BUILD)/completions/zsh/* $(DESTDIR)$(ZSHDIR)
	install -m 644 $(BUILD)/completions/fish/* $(DESTDIR)$(FISHDIR)
	install -m 644 $(BUILD)/web/mrz.js $(BUILD)/web/mrz.wasm $(TO)/share/mr/web
	install -m 644 lib/mr.h $(TO)/include
	install -m 644 $(BUILD)/libmr.a $(BUILD)/$(SONAME) $(DESTDIR)$(LIBDIR)
	ln -sf $(SONAME) $(DESTDIR)$(LIBDIR)/libmr.so
	echo "$$PC" >$(BUILD)/mr.pc && install -m 644 $(BUILD)/mr.pc $(DESTDIR)$(LIBDIR)/pkgconfig

uninstall:
	rm -f $(addprefix $(TO)/bin/,$(NAMES) mr-solve-mpi) \
		$(foreach n,1 5 7,$(addprefix $(TO)/share/man/man$n/,$(notdir $(wildcard man/*.$n))))
	rm -f $(addprefix $(DESTDIR)$(BASHDIR)/,$(NAMES)) $(addprefix $(DESTDIR)$(ZSHDIR)/_,$(NAMES)) \
		$(patsubst %,$(DESTDIR)$(FISHDIR)/%.fish,$(NAMES))
	rm -f $(TO)/share/mr/web/mrz.js $(TO)/share/mr/web/mrz.wasm
	rm -f $(TO)/include/mr.h $(addprefix $(DESTDIR)$(LIBDIR)/,libmr.a $(SONAME) libmr.so pkgconfig/mr.pc)

clean:
	rm -rf build

.PHONY: install uninstall completions clean
