# Builds for the Arduinos with an AVR, with Debian's AVR core, and what runs it, into the folder OUT (absolute)
#   OUT/BOARD/NAME.elf       the examples as they stand, and our own sketches, for mega, leonardo and uno
#   OUT/BOARD/NAME.rejected  what the compiler says of an example that cannot run on this board
#   OUT/BoardTest            the program that runs the sketches
#   mega                     all OUT/mega/NAME.elf
# `make list` names all of these.

# Absolute: run.sh and `make size` call this from different folders, and what depends on what is kept in one.
HERE := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
ROOT := $(abspath $(HERE)/../../..)
HOST := $(ROOT)/extras/host
ARDUINO ?= /usr/share/arduino/hardware/arduino/avr

EXAMPLES := $(notdir $(wildcard $(ROOT)/examples/*))
OURS_ALONE := Background Busy Choice InterruptsOff ManyStops ManyStopsBackground Masked OtherCode Pin PinBackground PinLoops PinLoopsPort
BOARDS := mega leonardo uno
# As in boards.txt: the chip, its name, the variant, and more.
mega := atmega2560 MEGA2560 mega
leonardo := atmega32u4 LEONARDO leonardo -DUSBCON -DUSB_VID=0x2341 -DUSB_PID=0x8036 -I$(ARDUINO)/libraries/HID/src
uno := atmega328p UNO standard
# What an example says on a board that it cannot run on; empty: it compiles. $1: the board, $2: the example.
reason = $(strip $(if $(filter leonardo-PwmIn uno-PwmIn,$1-$2),needs four pins with interrupts) \
  $(if $(filter uno-Loopback uno-Mixer uno-Sensor,$1-$2),An SBusPin only receives) \
  $(if $(filter leonardo-TwoReceivers leonardo-Trainer,$1-$2),needs a second port))
# Busy and Masked have a timer 2.
ours = $(if $(filter mega,$1),$(filter-out PinLoops%,$(OURS_ALONE)),$(if $(filter leonardo,$1),Background InterruptsOff,$(filter Pin%,$(OURS_ALONE))))
rejected = $(foreach name,$(EXAMPLES),$(if $(call reason,$1,$(name)),$(name)))
sketches = $(filter-out $(call rejected,$1),$(EXAMPLES)) $(call ours,$1)
elves = $(patsubst %,$(OUT)/$1/%.elf,$(call sketches,$1))
ALL := $(foreach board,$(BOARDS),$(call elves,$(board)) $(patsubst %,$(OUT)/$(board)/%.rejected,$(call rejected,$(board)))) \
  $(OUT)/BoardTest

all: $(ALL)
mega: $(call elves,mega)
list:
	@printf '%s\n' $(ALL)
.PHONY: all mega list
.DELETE_ON_ERROR:
.SECONDARY:

include $(ROOT)/extras/setup/flags.mk

# As in the core's platform.txt, but for -fpermissive.
chip = -mmcu=$(word 1,$($1)) -DF_CPU=16000000L -DARDUINO=10819 -DARDUINO_AVR_$(word 2,$($1)) -DARDUINO_ARCH_AVR -Os \
  -ffunction-sections -fdata-sections -flto $(wordlist 4,9,$($1))
AVR_C = avr-gcc $(call chip,$1) -std=gnu11
AVR_CXX = avr-g++ $(call chip,$1) -std=gnu++11 -fno-exceptions -fno-threadsafe-statics
core_includes = -I$(ARDUINO)/cores/arduino -I$(ARDUINO)/variants/$(word 3,$($1))
OURS = -I$(ROOT)/src -I$(HOST)/standin -I$(HERE)/core -I$(ARDUINO) -I$(ARDUINO)/libraries/SoftwareSerial/src $(call core_includes,$1)

# WString.cpp does not compile with Debian's avr-gcc 5.4; no sketch of ours has a String.
CORE_SOURCES := $(notdir $(filter-out %/WString.cpp,$(wildcard $(ARDUINO)/cores/arduino/*.c \
  $(ARDUINO)/cores/arduino/*.cpp $(ARDUINO)/cores/arduino/*.S)))
LIBRARY := $(patsubst $(ROOT)/src/%,%,$(wildcard $(ROOT)/src/*.cpp $(ROOT)/src/*/*.cpp $(ROOT)/src/*/*/*.cpp))

# $1: the board. An archive, as library.properties says: the interrupt of SBus2Sensor is only in sketches that have one.
# Examples are built as the IDE does it, but without prototypes: in them every function stands above its first use. Other
# people's sources are not ours to warn about.
define board_rules
$(OUT)/$1/%.elf: $(OUT)/$1/sketch/%.o $(OUT)/$1/library.a $(if $(filter leonardo,$1),$(OUT)/$1/HID.o) $(OUT)/$1/core.a
	avr-gcc $(call chip,$1) -fuse-linker-plugin -Wl,--gc-sections $$^ -lm -o $$@

$(patsubst %,$(OUT)/$1/sketch/%.o,$(call ours,$1)): $(OUT)/$1/sketch/%.o: $(HERE)/%.cpp $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(AVR_CXX) $(WARNINGS) $$(DEPENDENCIES) $(OURS) -c $$< -o $$@

$(OUT)/$1/%.rejected: $(ROOT)/examples/%/ $(ROOT)/src/SBusBoard.h $(HERE)/build.mk
	@mkdir -p $$(@D)
	! $(AVR_CXX) $(OURS) -x c++ -include Arduino.h -S -o /dev/null $(ROOT)/examples/$$*/$$*.ino 2>$$@
	grep -m 1 'error' $$@ | grep -q '$$(call reason,$1,$$*)'

$(OUT)/$1/library/%.cpp.o: $(ROOT)/src/%.cpp $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(AVR_CXX) $(WARNINGS) $$(DEPENDENCIES) $(OURS) -c $$< -o $$@
$(OUT)/$1/library.a: $(LIBRARY:%=$(OUT)/$1/library/%.o)
	@rm -f $$@
	avr-gcc-ar rcs $$@ $$^

$(OUT)/$1/core/%.c.o: $(ARDUINO)/cores/arduino/%.c $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(AVR_C) -w $(call core_includes,$1) -c $$< -o $$@
$(OUT)/$1/core/%.S.o: $(ARDUINO)/cores/arduino/%.S $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(AVR_C) -w -x assembler-with-cpp $(call core_includes,$1) -c $$< -o $$@
$(OUT)/$1/core/%.cpp.o: $(ARDUINO)/cores/arduino/%.cpp $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(AVR_CXX) -w $(call core_includes,$1) -c $$< -o $$@
$(OUT)/$1/core.a: $(CORE_SOURCES:%=$(OUT)/$1/core/%.o)
	@rm -f $$@
	avr-gcc-ar rcs $$@ $$^
endef
# $1: the board, $2: the example. The core's HID library and its macros of pins have warnings of their own; boards/cores has Joystick with ours.
define example
$(OUT)/$1/sketch/$2.o: $(ROOT)/examples/$2/$2.ino $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(AVR_CXX) $(if $(filter leonardo-Joystick uno-Servos,$1-$2),-w,$(WARNINGS)) $(OURS) -x c++ -include Arduino.h -c $$< $$(DEPENDENCIES) -o $$@
endef
$(foreach board,$(BOARDS),$(eval $(call board_rules,$(board))) \
  $(foreach name,$(EXAMPLES),$(eval $(call example,$(board),$(name)))))
$(OUT)/leonardo/HID.o: $(ARDUINO)/libraries/HID/src/HID.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call AVR_CXX,leonardo) -w $(call core_includes,leonardo) -c $< -o $@

# With the host's lines, and what of the core they and the expectations need.
TEST := $(filter-out $(OURS_ALONE:%=\%/%.cpp),$(wildcard $(HERE)/*.cpp)) \
  $(wildcard $(addprefix $(ROOT)/extras/line/,*.cpp simulation/*.cpp recording/*.cpp uart/*.cpp telemetry/*.cpp capture/Parsing.cpp system/Posix.cpp)) \
  $(wildcard $(ROOT)/src/sbus*/*.cpp)
$(OUT)/BoardTest: $(TEST:$(ROOT)/%.cpp=$(OUT)/pc/%.o)
	$(CXX) $^ -lsimavr -o $@
$(OUT)/pc/%.o: $(ROOT)/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 -O2 $(WARNINGS) $(DEPENDENCIES) -DELVES='"$(OUT)"' -I$(ROOT)/extras -I$(ROOT)/src -I$(ROOT)/test \
	  -c $< -o $@

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)
