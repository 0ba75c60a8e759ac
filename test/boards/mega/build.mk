# Builds for an Arduino Mega, and what runs it, into the folder OUT (absolute)
#   elves     OUT/NAME.elf: the examples as they stand, with Debian's AVR core, and our sketch Counters
#   refused   OUT/NAME.refused: what the compiler says to the examples that are not for this board
#   runner    OUT/runner, the program that runs an .elf
#   host      OUT/host/NAME, examples on the host's plain core

# Absolute: run.sh and `make size` call this from different folders, and what depends on what is kept in one.
HERE := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
ROOT := $(HERE)/../../..
HOST := $(ROOT)/extras/host
ARDUINO ?= /usr/share/arduino/hardware/arduino/avr

# Background needs Serial1.onReceive(), which only the STM32L0 core has, and says so with an #error.
REFUSED := Background
EXAMPLES := $(filter-out $(REFUSED),$(notdir $(wildcard $(ROOT)/examples/*)))
SKETCHES := $(EXAMPLES) Counters
# What the plain core tells in other words than the board's.
ON_HOST := Diagnose
ELVES := $(SKETCHES:%=$(OUT)/%.elf)

elves: $(ELVES)
refused: $(REFUSED:%=$(OUT)/%.refused)
runner: $(OUT)/runner
list-examples:
	@printf '%s\n' $(EXAMPLES)
list-refused:
	@printf '%s\n' $(REFUSED)
.PHONY: elves refused runner host list-examples list-refused FORCE
.DELETE_ON_ERROR:
.SECONDARY:

include $(ROOT)/extras/setup/flags.mk

# As in the core's platform.txt and boards.txt, but for -flto, which says nothing of who needs what, and -fpermissive.
AVR := -mmcu=atmega2560 -DF_CPU=16000000L -DARDUINO=10819 -DARDUINO_AVR_MEGA2560 -DARDUINO_ARCH_AVR -Os \
  -ffunction-sections -fdata-sections
AVR_C := avr-gcc $(AVR) -std=gnu11
AVR_CXX := avr-g++ $(AVR) -std=gnu++11 -fno-exceptions -fno-threadsafe-statics
CORE_INCLUDES := -I$(ARDUINO)/cores/arduino -I$(ARDUINO)/variants/mega
OURS := -I$(ROOT)/src -I$(HOST)/standin -I$(HERE)/standin -I$(HERE)/core -I$(ARDUINO) $(CORE_INCLUDES)

# WString.cpp does not compile with Debian's avr-gcc 5.4; no sketch of ours has a String.
CORE_SOURCES := $(notdir $(filter-out %/WString.cpp,$(wildcard $(ARDUINO)/cores/arduino/*.c \
  $(ARDUINO)/cores/arduino/*.cpp $(ARDUINO)/cores/arduino/*.S)))
LIBRARY := $(patsubst $(ROOT)/src/%,%,$(wildcard $(ROOT)/src/*.cpp $(ROOT)/src/*/*.cpp))

$(OUT)/%.elf: $(OUT)/sketch/%.o $(LIBRARY:%=$(OUT)/library/%.o) $(OUT)/core.a
	avr-gcc $(AVR) -Wl,--gc-sections $^ -lm -o $@

$(OUT)/sketch/Counters.o: $(HERE)/Counters.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(AVR_CXX) $(WARNINGS) $(DEPENDENCIES) $(OURS) -c $< -o $@

# As the IDE does it, but without prototypes: in the examples every function stands above its first use.
sketch = $(AVR_CXX) $(WARNINGS) $(OURS) -x c++ -include Arduino.h -c $1
define example
$(OUT)/sketch/$1.o: $(ROOT)/examples/$1/$1.ino $(HERE)/build.mk
	@mkdir -p $$(@D)
	$$(call sketch,$$<) $$(DEPENDENCIES) -o $$@
endef
$(foreach name,$(EXAMPLES),$(eval $(call example,$(name))))

# Fails if the compiler does not. What it says is kept.
$(OUT)/%.refused: $(ROOT)/examples/%/ FORCE
	@mkdir -p $(@D)
	! $(call sketch,$(ROOT)/examples/$*/$*.ino) -o /dev/null 2>$@

$(OUT)/library/%.cpp.o: $(ROOT)/src/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(AVR_CXX) $(WARNINGS) $(DEPENDENCIES) $(OURS) -c $< -o $@

# Stands with the core, so that only a sketch that has servos has their interrupt.
$(OUT)/standin/%.o: $(HERE)/standin/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(AVR_CXX) $(WARNINGS) $(DEPENDENCIES) $(OURS) -c $< -o $@

# Other people's sources are not ours to warn about.
$(OUT)/core/%.c.o: $(ARDUINO)/cores/arduino/%.c $(HERE)/build.mk
	@mkdir -p $(@D)
	$(AVR_C) -w $(CORE_INCLUDES) -c $< -o $@
$(OUT)/core/%.S.o: $(ARDUINO)/cores/arduino/%.S $(HERE)/build.mk
	@mkdir -p $(@D)
	$(AVR_C) -w -x assembler-with-cpp $(CORE_INCLUDES) -c $< -o $@
$(OUT)/core/%.cpp.o: $(ARDUINO)/cores/arduino/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(AVR_CXX) -w $(CORE_INCLUDES) -c $< -o $@
$(OUT)/core.a: $(CORE_SOURCES:%=$(OUT)/core/%.o) $(OUT)/standin/Servo.o
	@rm -f $@
	avr-ar rcs $@ $^

# The runner, with the host's lines. An inverter stands in front of the pin, as in front of the host's plain core.
RUNNER := $(patsubst $(HERE)/%,%,$(filter-out %/Counters.cpp,$(wildcard $(HERE)/*.cpp)))
ROOMS := $(patsubst $(ROOT)/extras/%.cpp,%,$(wildcard $(ROOT)/extras/line/*.cpp)) host/board/Eeprom
CORE := Calibration Frame FrameFinder Scaling
RUNNER_CXX = $(CXX) -std=c++17 -O2 $(WARNINGS) -DHOST_PLAIN_CORE $(DEPENDENCIES) -I$(HERE) -I$(HOST) -I$(ROOT)/extras -I$(ROOT)/src -I$(ROOT)/test

$(OUT)/runner: $(RUNNER:%.cpp=$(OUT)/runner-objects/%.o) $(ROOMS:%=$(OUT)/runner-objects/%.o) \
  $(CORE:%=$(OUT)/runner-objects/sbus/%.o)
	$(CXX) $^ -lsimavr -o $@
$(OUT)/runner-objects/%.o: $(HERE)/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(RUNNER_CXX) -c $< -o $@
$(OUT)/runner-objects/line/%.o: $(ROOT)/extras/line/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(RUNNER_CXX) -c $< -o $@
$(OUT)/runner-objects/host/%.o: $(HOST)/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(RUNNER_CXX) -c $< -o $@
$(OUT)/runner-objects/sbus/%.o: $(ROOT)/src/sbus/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(RUNNER_CXX) -c $< -o $@

# One after the other: they share their objects.
host:
	@set -e; for name in $(ON_HOST); do $(MAKE) --no-print-directory -C $(HOST) SKETCH=examples/$$name \
	  BUILD=$(OUT)/host CXXFLAGS='-O1 -DHOST_PLAIN_CORE'; done

-include $(shell find $(OUT) -name '*.d' -not -path '*/host/*' 2>/dev/null)
