# Builds the unit programs for the Cortex-M0, with CROSS, into the folder OUT (absolute)
#   unit         OUT/unit/*Test, but for those in LEFT_OUT: from the sources of the host's
#   alignment    OUT/UnalignedRead, which reads a word from an odd address
# `make list-unit` names the unit programs.

# Absolute: what depends on what is kept in OUT, and this may be called from any folder.
HERE := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
ROOT := $(HERE)/../../..
SRC := $(ROOT)/src
HOST := $(ROOT)/extras/host
TEST := $(ROOT)/test
CROSS ?= arm-none-eabi-g++

CPU := -mcpu=cortex-m0 -mthumb
include $(ROOT)/extras/setup/flags.mk
BOARD += -Os
# Of the C++ library only the headers are here. Nothing was compiled by a GCC older than 7; doctest compares a signed
# with an unsigned number without a warning.
TESTS := -std=gnu++17 -O1 -fno-exceptions -fno-rtti -fno-threadsafe-statics -Wno-psabi -Wno-sign-compare
SECTIONS := -ffunction-sections -fdata-sections
ARDUINO := -I$(HOST)/arduino -I$(HOST)/standin
INCLUDES := -I$(TEST) -I$(SRC) -I$(HOST) -I$(ROOT)/extras $(ARDUINO) -I$(HERE)

# PreemptTest and PreemptListeningTest live on x86's trap flag and Linux's signals, SBus2SensorTest plays to a simulated
# S.BUS2 wire, and FifoWatchTest needs 45 million steps.
LEFT_OUT := FifoWatchTest PreemptTest PreemptListeningTest SBus2SensorTest
RUNTIME := $(OUT)/Main.o $(OUT)/Runtime.o $(OUT)/Start.o
UNIT := $(filter-out $(LEFT_OUT),$(patsubst $(TEST)/unit/%.cpp,%,$(wildcard $(TEST)/unit/*Test.cpp)))
LIBRARY := $(patsubst $(SRC)/%.cpp,%,$(wildcard $(SRC)/*.cpp $(SRC)/*/*.cpp))
ROOMS := host/board/BoardUart line/LineSettings line/simulation/SimulatedReceiver

unit: $(UNIT:%=$(OUT)/unit/%)
alignment: $(OUT)/UnalignedRead
list-unit:
	@printf '%s\n' $(UNIT)
.PHONY: unit alignment list-unit
.DELETE_ON_ERROR:
.SECONDARY:

# The driver of C links no C++ library.
include $(HERE)/link.mk
link = $(CROSS:%g++=%gcc) $(CPU) $(MICROBIT) $(filter %.o %.a,$^) -lm -o $@

$(OUT)/unit/%Test: $(OUT)/unit/%Test.o $(RUNTIME) $(OUT)/board.a
	$(link)
$(OUT)/%Read: $(OUT)/%Read.o $(OUT)/Start.o
	$(link)

compile = $(CROSS) $(CPU) $1 $(SECTIONS) $(WARNINGS) $(DEPENDENCIES) $(INCLUDES) -c $< -o $@
$(OUT)/unit/%.o: $(TEST)/unit/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call compile,$(TESTS))
$(OUT)/Main.o $(OUT)/Runtime.o: $(OUT)/%.o: $(HERE)/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call compile,$(TESTS))
$(OUT)/%.o: $(HERE)/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call compile,$(BOARD))

# The library as on the board.
$(OUT)/board/src/%.o: $(SRC)/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call compile,$(BOARD))
$(OUT)/board/arduino/%.o: $(HOST)/arduino/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call compile,$(BOARD))
$(OUT)/board/host/%.o: $(HOST)/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call compile,$(TESTS))
$(OUT)/board/line/%.o: $(ROOT)/extras/line/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call compile,$(TESTS))
$(OUT)/board/FakeClock.o: $(TEST)/support/FakeClock.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(call compile,$(BOARD))
$(OUT)/board.a: $(LIBRARY:%=$(OUT)/board/src/%.o) $(OUT)/board/arduino/Print.o $(ROOMS:%=$(OUT)/board/%.o) \
  $(OUT)/board/FakeClock.o
	@rm -f $@
	arm-none-eabi-ar rcs $@ $^

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)
