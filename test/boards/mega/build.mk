# Builds for an Arduino Mega, and what runs it, into the folder OUT (absolute)
#   elves           OUT/NAME.elf: the examples as they stand, with Debian's AVR core, and our own sketches
#   OUT/Joystick.leonardo  the example Joystick for the Leonardo, whose USB makes one
#   OUT/MegaTest    the program that runs the sketches
# `make list` names all of these.

# Absolute: run.sh and `make size` call this from different folders, and what depends on what is kept in one.
HERE := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
ROOT := $(abspath $(HERE)/../../..)
HOST := $(ROOT)/extras/host
ARDUINO ?= /usr/share/arduino/hardware/arduino/avr

EXAMPLES := $(notdir $(wildcard $(ROOT)/examples/*))
OURS_ALONE := Background Counters Busy InterruptsOff
SKETCHES := $(EXAMPLES) $(OURS_ALONE)
ELVES := $(SKETCHES:%=$(OUT)/%.elf)
ALL := $(ELVES) $(OUT)/Joystick.leonardo $(OUT)/MegaTest

all: $(ALL)
elves: $(ELVES)
list:
	@printf '%s\n' $(ALL)
.PHONY: all elves list
.DELETE_ON_ERROR:
.SECONDARY:

include $(ROOT)/extras/setup/flags.mk

# As in the core's platform.txt and boards.txt, but for -flto, which says nothing of who needs what, and -fpermissive.
AVR := -mmcu=atmega2560 -DF_CPU=16000000L -DARDUINO=10819 -DARDUINO_AVR_MEGA2560 -DARDUINO_ARCH_AVR -Os \
  -ffunction-sections -fdata-sections
AVR_C := avr-gcc $(AVR) -std=gnu11
AVR_CXX := avr-g++ $(AVR) -std=gnu++11 -fno-exceptions -fno-threadsafe-statics
CORE_INCLUDES := -I$(ARDUINO)/cores/arduino -I$(ARDUINO)/variants/mega
OURS := -I$(ROOT)/src -I$(HOST)/standin -I$(HERE)/core -I$(ARDUINO) $(CORE_INCLUDES)

# WString.cpp does not compile with Debian's avr-gcc 5.4; no sketch of ours has a String.
CORE_SOURCES := $(notdir $(filter-out %/WString.cpp,$(wildcard $(ARDUINO)/cores/arduino/*.c \
  $(ARDUINO)/cores/arduino/*.cpp $(ARDUINO)/cores/arduino/*.S)))
LIBRARY := $(patsubst $(ROOT)/src/%,%,$(wildcard $(ROOT)/src/*.cpp $(ROOT)/src/*/*.cpp))

# An archive, as library.properties says: the interrupt of SBus2Sensor is only in sketches that have one.
$(OUT)/%.elf: $(OUT)/sketch/%.o $(OUT)/library.a $(OUT)/core.a
	avr-gcc $(AVR) -Wl,--gc-sections $^ -lm -o $@

$(OURS_ALONE:%=$(OUT)/sketch/%.o): $(OUT)/sketch/%.o: $(HERE)/%.cpp $(HERE)/build.mk
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

# The core's HID library has warnings of its own. boards/cores has the same code with ours.
leonardo = $(subst variants/mega,variants/leonardo,$(subst MEGA2560,LEONARDO,$(subst atmega2560,atmega32u4,$1)))
$(OUT)/Joystick.leonardo: $(ROOT)/examples/Joystick/Joystick.ino $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call leonardo,$(AVR_CXX) $(OURS)) -w -DUSBCON -DUSB_VID=0x2341 -DUSB_PID=0x8036 -I$(ARDUINO)/libraries/HID/src $(DEPENDENCIES) \
	  -x c++ -include Arduino.h -c $< -o $@

$(OUT)/library/%.cpp.o: $(ROOT)/src/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(AVR_CXX) $(WARNINGS) $(DEPENDENCIES) $(OURS) -c $< -o $@

$(OUT)/library.a: $(LIBRARY:%=$(OUT)/library/%.o)
	@rm -f $@
	avr-ar rcs $@ $^

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
$(OUT)/core.a: $(CORE_SOURCES:%=$(OUT)/core/%.o)
	@rm -f $@
	avr-ar rcs $@ $^

# With the host's lines, and what of the core they and the expectations need.
TEST := $(filter-out $(OURS_ALONE:%=\%/%.cpp),$(wildcard $(HERE)/*.cpp)) \
  $(wildcard $(ROOT)/extras/line/*.cpp $(addprefix $(ROOT)/extras/line/,simulation/*.cpp recording/*.cpp uart/*.cpp telemetry/*.cpp)) $(wildcard $(ROOT)/src/sbus/*.cpp)
$(OUT)/MegaTest: $(TEST:$(ROOT)/%.cpp=$(OUT)/pc/%.o)
	$(CXX) $^ -lsimavr -o $@
$(OUT)/pc/%.o: $(ROOT)/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 -O2 $(WARNINGS) $(DEPENDENCIES) -DELVES='"$(OUT)"' -I$(ROOT)/extras -I$(ROOT)/src -I$(ROOT)/test \
	  -c $< -o $@

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)
