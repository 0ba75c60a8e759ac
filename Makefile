# `make` prints what it can do. The work itself stands in extras/host/Makefile, extras/cli/Makefile,
# extras/scope/Makefile and test/Makefile.

.DEFAULT_GOAL := help

work := help demo sbus install uninstall scope test test-all impairment fuzz size bench figures docs format clean
.PHONY: $(work) zip dist release
zip:
	@sh extras/setup/zip.sh
release:
	@sh extras/setup/release.sh

# make cannot handle names with blanks.
ifneq ($(words $(CURDIR)),1)
$(work) dist:
	@echo "make: the name of this folder has a blank, or that of a folder around it. Rename it." >&2; exit 1
else

dist:
	@sh extras/setup/packages.sh git
	@sh extras/setup/zip.sh >/dev/null
	@sh extras/setup/packages.sh dpkg-dev $(TOOL) $(SCOPE) $(STATIC)
	@sh extras/setup/dist.sh

help:
	@cat extras/setup/help.txt

# A `make -j` of the user brings processes of its own. Two runs in this folder build one after the other.
jobs = $(if $(findstring jobserver,$(MAKEFLAGS)),,-j$$(nproc))
build = mkdir -p build && $(if $(shell command -v flock),flock build/making) $(MAKE) --no-print-directory -s $(jobs)

SKETCH ?= examples/DecodeSBus
sketch_name = $(notdir $(SKETCH:/=))
sketch_options = $(shell sed -n 's/^$(sketch_name) //p' extras/host/OPTIONS)

demo:
	@sh extras/setup/packages.sh g++ libcli11-dev libserialport-dev
	+@$(build) -C extras/host SKETCH='$(SKETCH)' 1>&2
	@build/host/$(sketch_name) $(if $(SOURCE),--source '$(SOURCE)',$(sketch_options))

sbus:
	@sh extras/setup/packages.sh $(TOOL)
	+@$(build) -C extras/cli
	@echo build/sbus/sbus

SBUS := build/sbus/sbus
PREFIX ?= /usr/local
installed := $(subst ','\'',$(DESTDIR)$(PREFIX))
install: $(if $(filter file,$(origin SBUS)),sbus)
	@install -D '$(subst ','\'',$(SBUS))' '$(installed)/bin/sbus'
	@install -D -m 644 /dev/null '$(installed)/share/man/man1/sbus.1'
	@'$(subst ','\'',$(SBUS))' __manual <extras/cli/sbus.1.in >'$(installed)/share/man/man1/sbus.1'
	@install -D -m 644 extras/cli/completion.zsh '$(installed)/share/zsh/site-functions/_sbus'
	@install -D -m 644 extras/cli/completion.fish '$(installed)/share/fish/vendor_completions.d/sbus.fish'
	@install -D -m 644 extras/cli/completion.bash '$(installed)/share/bash-completion/completions/sbus'
	@echo '$(installed)/bin/sbus'

# Folders that a system has anyway stay.
uninstall:
	@rm -fv $(foreach file,bin/sbus share/man/man1/sbus.1 share/bash-completion/completions/sbus \
	  share/zsh/site-functions/_sbus share/fish/vendor_completions.d/sbus.fish,'$(installed)/$(file)')
	@rmdir $(foreach folder,share/bash-completion/completions share/bash-completion share/zsh/site-functions share/zsh \
	  share/fish/vendor_completions.d share/fish share/man/man1 \
	  $(if $(filter /usr /usr/local,$(PREFIX)),,share/man share bin),'$(installed)/$(folder)') \
	  $(if $(filter /usr /usr/local,$(PREFIX)),,'$(installed)') 2>/dev/null || :

SCOPE_PORT ?= 8000
scope:
	@sh extras/setup/packages.sh $(SCOPE)
	+@$(build) -C extras/scope
	@node extras/scope/serve.mjs build/scope/index.html '$(SCOPE_PORT)'

CAPTURES ?=
# WebAssembly; a machine may have npm from elsewhere, which Debian's would throw out.
SCOPE := clang lld libc++-dev-wasm32 libclang-rt-dev-wasm32 nlohmann-json3-dev $(if $(shell command -v npm),,nodejs npm)
TOOL := g++ libcli11-dev libserialport-dev libncurses-dev libarchive-dev nlohmann-json3-dev
# What TOOL's static libraries need.
STATIC := nettle-dev liblzma-dev libzstd-dev libbz2-dev zlib1g-dev
AVR := gcc-avr avr-libc arduino-core-avr
TEST := g++ python3 doctest-dev libcli11-dev libserialport-dev libarchive-dev nlohmann-json3-dev
# Debian 14 has picolibc for newlib.
ARM := gcc-arm-none-eabi 'libnewlib-arm-none-eabi|picolibc-arm-none-eabi'
# The headers of the C++ library alone, 17 MB; the library has 1.5 GB.
ARM_CXX := 'libstdc++-arm-none-eabi-dev?'

test:
	@sh extras/setup/packages.sh $(TEST)
	@$(MAKE) --no-print-directory $(jobs) -C test

test-all:
	@sh extras/setup/packages.sh $(TEST) clang clang-sanitizers libncurses-dev jq 'pkg-config|pkgconf' tmux 'zsh?' 'fish?' git unzip dpkg-dev $(STATIC) 'clang-format-14?' cmake python3-yaml python3-markdown-it $(SCOPE) 'chromium?' $(AVR) libsimavr-dev $(ARM) $(ARM_CXX) qemu-system-arm 'sigrok-cli?' doxygen
	@$(MAKE) --no-print-directory $(jobs) -C test test-all CAPTURES='$(if $(CAPTURES),$(if $(filter /%,$(firstword $(CAPTURES))),,$(CURDIR)/)$(CAPTURES))'

impairment:
	@sh extras/setup/packages.sh $(TEST)
	@$(MAKE) --no-print-directory -s -C test impairment

fuzz:
	@sh extras/setup/packages.sh clang clang-sanitizers nlohmann-json3-dev
	@$(MAKE) --no-print-directory -C test fuzz

size:
	@sh extras/setup/packages.sh $(AVR) $(ARM) $(ARM_CXX)
	@$(MAKE) --no-print-directory -C test size

bench:
	@sh extras/setup/packages.sh $(ARM) $(ARM_CXX) qemu-system-arm
	@$(MAKE) --no-print-directory -C test bench

figures:
	@sh extras/setup/packages.sh $(TEST) $(AVR) libsimavr-dev $(ARM) $(ARM_CXX) qemu-system-arm
	@extras/docs/figures.sh

docs:
	@sh extras/setup/packages.sh doxygen
	@rm -rf build/docs && mkdir -p build/docs
	@doxygen extras/docs/Doxyfile
	@echo build/docs/html/index.html

format:
	@sh extras/setup/packages.sh 'clang-format-14?'
	@extras/setup/format.sh

clean:
	rm -rf build/* build dist

endif
