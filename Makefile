# `make` prints what it can do. The work itself stands in extras/host/Makefile, extras/cli/Makefile,
# extras/scope/Makefile and test/Makefile.

.DEFAULT_GOAL := help

work := help demo sbus install uninstall scope test test-all impairment fuzz size bench figures docs clean
.PHONY: $(work) zip dist release
zip:
	@sh extras/setup/zip.sh
release:
	@sh extras/setup/release.sh

# make cannot handle names with spaces. If this folder's name has one, the work is done in a copy whose name has none, and
# the results are in build/ here.
ifneq ($(words $(CURDIR)),1)
absolute = $(if $($1),$1='$(if $(filter /%,$(firstword $($1))),,$(CURDIR)/)$($1)')
$(work):
	@copy=$$(sh extras/setup/copy.sh) && $(MAKE) --no-print-directory -C "$$copy" $@ $(call absolute,CAPTURES) \
	  $(if $(wildcard $(SOURCE)),$(call absolute,SOURCE),$(if $(SOURCE),SOURCE='$(SOURCE)')) $(call absolute,PREFIX) $(call absolute,DESTDIR) && { [ $@ != clean ] || rm -rf "$$copy"; }
dist:
	@echo "make dist: the name of this folder has a blank. Rename it." >&2; exit 1
else

dist:
	@sh extras/setup/packages.sh git dpkg-dev $(TOOL) $(SCOPE) $(STATIC) 'g++-aarch64-linux-gnu?'
	@sh extras/setup/dist.sh

help:
	@echo "make demo   runs examples/DecodeSBus on a simulated receiver, 15 seconds; installs what it needs"
	@echo "            SKETCH=examples/NAME  another sketch"
	@echo "            SOURCE=file           a recorded line"
	@echo "            SOURCE=/dev/ttyUSB0   a real receiver, on an FTDI adapter with inverted RXD"
	@echo "            SOURCE=sim:24         another simulated receiver, see extras/host"
	@echo "            PTY=1                 the output also on a pseudo-terminal, for a serial plotter"
	@echo "make sbus   builds build/sbus/sbus: looks at lines, records, replays and diagnoses them; see extras/cli"
	@echo "make install PREFIX=/usr/local  installs it, its manual, completion for bash, zsh and fish, a udev rule"
	@echo "make uninstall PREFIX=/usr/local  removes these again"
	@echo "make scope  builds build/scope/index.html, a page for the browser that shows S.Bus, and serves it; SCOPE_PORT=8000"
	@echo "make test   the tests that a change needs: a minute; installs what it needs"
	@echo "            ONLY=LinkTest         one file of test/unit or test/host"
	@echo "            SEED=n                another seed than today's"
	@echo "            V=1                   prints everything"
	@echo "make test-all  every test: sanitizers, a second compiler, simulated boards, the page, the command, fuzzing"
	@echo "            CAPTURES=dir          also replays recordings of real receivers in dir"
	@echo "make impairment  the table of what comes through impaired lines: ours beside the baseline, the paper's listing"
	@echo "            FRAMES=n              frames per line, FULL=1 the whole table"
	@echo "make fuzz   libFuzzer on receiver, packer, calibration and recording reader, SECONDS=n each"
	@echo "make size   what the library and the examples take of flash and RAM, on AVR and Cortex-M0+"
	@echo "make bench  what receiving, decoding and encoding cost, in instructions of a Cortex-M0"
	@echo "            TRIES=200000          how long the longest call is searched for"
	@echo "make figures  writes the tables of extras/docs/measured.md (impairment, size, bench); some minutes"
	@echo "make docs   the API reference, build/docs/html/index.html"
	@echo "make zip    the library as the Arduino IDE takes it, build/DecodeSBus-VERSION.zip"
	@echo "make dist   what a release offers, in dist/: ZIP, page, sbus as a Debian package and for any Linux, SHA256SUMS"
	@echo "make release VERSION=x.y.z  sets the version, dates CHANGELOG.md, fills in every placeholder, says what is left to do"
	@echo "            URL=https://github.com/NAME/DecodeSBus MAINTAINER='NAME <ADDRESS>'  the first time"
	@echo "make clean  removes build/ and dist/"

SKETCH ?= examples/DecodeSBus
sketch_name = $(notdir $(SKETCH:/=))
sketch_options = $(shell sed -n 's/^$(sketch_name) //p' extras/host/OPTIONS $(if $(PTY),| sed 's/--seconds [0-9]*//'))

demo:
	@sh extras/setup/packages.sh g++ libcli11-dev libserialport-dev
	@$(MAKE) --no-print-directory -s -j$$(nproc) -C extras/host SKETCH='$(SKETCH)' 1>&2
	@build/host/$(sketch_name) $(if $(SOURCE),--source '$(SOURCE)',$(sketch_options)) \
	  $(if $(PTY),--pty)

sbus:
	@sh extras/setup/packages.sh $(TOOL)
	@$(MAKE) --no-print-directory -s -j$$(nproc) -C extras/cli
	@echo build/sbus/sbus

SBUS := build/sbus/sbus
PREFIX ?= /usr/local
installed := $(DESTDIR)$(PREFIX)
install: $(if $(filter file,$(origin SBUS)),sbus)
	@install -D '$(SBUS)' '$(installed)/bin/sbus'
	@install -D -m 644 extras/cli/sbus.1 '$(installed)/share/man/man1/sbus.1'
	@install -D -m 644 extras/cli/completion.zsh '$(installed)/share/zsh/site-functions/_sbus'
	@install -D -m 644 extras/cli/completion.fish '$(installed)/share/fish/vendor_completions.d/sbus.fish'
	@install -D -m 644 extras/cli/completion.bash '$(installed)/share/bash-completion/completions/sbus'
	@install -D -m 644 extras/cli/60-sbus-uinput.rules '$(installed)/lib/udev/rules.d/60-sbus-uinput.rules'
	@echo '$(installed)/bin/sbus'

uninstall:
	@rm -fv $(foreach file,bin/sbus share/man/man1/sbus.1 share/bash-completion/completions/sbus \
	  share/zsh/site-functions/_sbus share/fish/vendor_completions.d/sbus.fish lib/udev/rules.d/60-sbus-uinput.rules,'$(installed)/$(file)')

SCOPE_PORT ?= 8000
scope:
	@sh extras/setup/packages.sh $(SCOPE)
	@$(MAKE) --no-print-directory -s -j$$(nproc) -C extras/scope
	@node extras/scope/serve.mjs build/scope/index.html '$(SCOPE_PORT)'

CAPTURES ?=
# WebAssembly; a machine may have npm from elsewhere, which Debian's would throw out.
SCOPE := clang lld libc++-dev-wasm32 libclang-rt-dev-wasm32 nlohmann-json3-dev $(if $(shell command -v npm),,nodejs npm)
TOOL := g++ libcli11-dev libserialport-dev libncurses-dev libarchive-dev libevdev-dev nlohmann-json3-dev 'pkg-config|pkgconf'
# What TOOL's static libraries need.
STATIC := nettle-dev liblzma-dev libzstd-dev libbz2-dev zlib1g-dev
AVR := gcc-avr avr-libc arduino-core-avr
TEST := g++ doctest-dev librapidcheck-dev libcli11-dev libserialport-dev libarchive-dev nlohmann-json3-dev
# Debian 14 has picolibc for newlib.
ARM := gcc-arm-none-eabi 'libnewlib-arm-none-eabi|picolibc-arm-none-eabi'
# The headers of the C++ library alone, 17 MB; the library has 1.5 GB.
ARM_CXX := 'libstdc++-arm-none-eabi-dev?'

test:
	@sh extras/setup/packages.sh $(TEST)
	@$(MAKE) --no-print-directory -j$$(nproc) -C test

test-all:
	@sh extras/setup/packages.sh $(TEST) clang clang-sanitizers libncurses-dev libevdev-dev jq 'pkg-config|pkgconf' tmux 'zsh?' 'fish?' git unzip dpkg-dev $(STATIC) cmake python3-yaml $(SCOPE) 'chromium?' $(AVR) libsimavr-dev $(ARM) $(ARM_CXX) qemu-system-arm 'sigrok-cli?' doxygen
	@$(MAKE) --no-print-directory -j$$(nproc) -C test test-all CAPTURES='$(if $(CAPTURES),$(if $(filter /%,$(firstword $(CAPTURES))),,$(CURDIR)/)$(CAPTURES))'

impairment:
	@sh extras/setup/packages.sh $(TEST)
	@$(MAKE) --no-print-directory -s -C test impairment

fuzz:
	@sh extras/setup/packages.sh clang clang-sanitizers
	@$(MAKE) --no-print-directory -C test fuzz

size:
	@sh extras/setup/packages.sh $(AVR) $(ARM)
	@$(MAKE) --no-print-directory -C test size

bench:
	@sh extras/setup/packages.sh $(ARM) $(ARM_CXX) qemu-system-arm
	@$(MAKE) --no-print-directory -C test bench

figures:
	@sh extras/setup/packages.sh $(TEST) $(AVR) $(ARM) $(ARM_CXX) qemu-system-arm
	@extras/docs/figures.sh

docs:
	@sh extras/setup/packages.sh doxygen
	@rm -rf build/docs && mkdir -p build/docs
	@doxygen extras/docs/Doxyfile
	@echo build/docs/html/index.html

clean:
	rm -rf build/* build dist

endif
