# Builds the bench for the Cortex-M0, with CROSS, into the folder OUT (absolute): OUT/Bench. The start-up code is that of
# ../boards/cortex-m0.

HERE := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
ROOT := $(HERE)/../..
SRC := $(ROOT)/src
HOST := $(ROOT)/extras/host
TEST := $(ROOT)/test
M0 := $(TEST)/boards/cortex-m0
CROSS ?= arm-none-eabi-g++

# As on the Grasshopper: its M0+ has the instructions of an M0, in another order at most.
CPU := -mcpu=cortex-m0plus -mthumb -Os
include $(ROOT)/extras/setup/flags.mk
include $(M0)/link.mk
SECTIONS := -ffunction-sections -fdata-sections
PLAIN := -std=gnu++17 -fno-exceptions -fno-rtti -fno-threadsafe-statics -Wno-psabi
INCLUDES := -I$(TEST) -I$(M0) -I$(SRC) -I$(HOST) -I$(ROOT)/extras -I$(HOST)/arduino

LIBRARY := $(patsubst $(SRC)/%.cpp,%,$(wildcard $(SRC)/*.cpp $(SRC)/*/*.cpp))
MEASURED := BenchReceivers
PARTS := Bench Cost FrameCosts LongestCall

bench: $(OUT)/Bench
.PHONY: bench
.DELETE_ON_ERROR:

$(OUT)/Bench: $(LIBRARY:%=$(OUT)/src/%.o) $(MEASURED:%=$(OUT)/%.o) $(PARTS:%=$(OUT)/%.o) $(OUT)/Start.o $(OUT)/Runtime.o \
  $(OUT)/BoardUart.o $(OUT)/BenchClock.o $(OUT)/Print.o
	$(CROSS:%g++=%gcc) $(CPU) $(MICROBIT) $(filter %.o,$^) -lm -o $@

compile = $(CROSS) $(CPU) $1 $(SECTIONS) $(WARNINGS) $(DEPENDENCIES) $(INCLUDES) -c $< -o $@
# What is measured is compiled as on the board, the bench itself as suits it.
define rule
$(OUT)/$1: $2 $(HERE)/build.mk
	@mkdir -p $$(@D)
	$$(call compile,$3)
endef
$(eval $(call rule,src/%.o,$(SRC)/%.cpp,$(BOARD)))
$(foreach part,$(MEASURED),$(eval $(call rule,$(part).o,$(HERE)/$(part).cpp,$(BOARD))))
$(eval $(call rule,Start.o,$(M0)/Start.cpp,$(BOARD)))
$(eval $(call rule,BenchClock.o,$(HERE)/BenchClock.cpp,$(BOARD)))
$(eval $(call rule,Print.o,$(HOST)/arduino/Print.cpp,$(BOARD)))
$(eval $(call rule,Runtime.o,$(M0)/Runtime.cpp,$(PLAIN)))
$(eval $(call rule,BoardUart.o,$(HOST)/board/BoardUart.cpp,$(PLAIN)))
$(foreach part,$(PARTS),$(eval $(call rule,$(part).o,$(HERE)/$(part).cpp,$(PLAIN))))

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)
