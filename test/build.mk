# Builds, with one compiler: CXX, into the folder OUT
#   unit      the unit programs, OUT/unit/*Test
#   compile   what only has to compile: OUT/alone/*.ok, each header of the core alone; OUT/macros/*.o, the core behind
#             Arduino's macros; OUT/cross/*.o, the library for the board's processor (by CROSS, not CXX)
#   OUT/line/*, OUT/line-sanitized/*   the torture bench
# `make list-unit` and `make list-compile` name what these two are made of.

SRC := ../src
HOST := ../extras/host
CROSS ?= arm-none-eabi-g++

WARNINGS := -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wold-style-cast -Werror
SANITIZE := -fsanitize=address,undefined -fno-sanitize-recover=all
# The board's core compiles everything with these.
BOARD := -std=gnu++11 -fno-exceptions -fno-rtti
DEBUG := -g -O1
ARDUINO := -I$(HOST)/arduino -I$(HOST)/standin
DEPENDENCIES = -MMD -MP -MT $@ -MF $@.d

CORE_SOURCES := $(patsubst $(SRC)/%,%,$(wildcard $(SRC)/sbus/*.cpp))
CORE_HEADERS := $(patsubst $(SRC)/%,%,$(wildcard $(SRC)/sbus/*.h))
SOURCES := $(wildcard $(SRC)/*.cpp)
SOURCES := $(CORE_SOURCES) $(SOURCES:$(SRC)/%=%)
ARDUINO_SOURCES := Print.cpp  # what a HardwareSerial is made of; the ports themselves are fakes
# Of the host's runtime: how the board receives and sends, what ports make of other settings, what it replays, and the
# simulated radio.
RUNTIME_SOURCES := BoardUart.cpp BoardTransmitter.cpp PortSettings.cpp UartSampler.cpp Recording.cpp \
  SimulatedReceiver.cpp Calibration.cpp

UNIT := $(patsubst unit/%.cpp,$(OUT)/unit/%,$(wildcard unit/*Test.cpp))
COMPILE := $(CORE_HEADERS:%=$(OUT)/alone/%.ok) $(CORE_SOURCES:%.cpp=$(OUT)/macros/%.o) $(SOURCES:%.cpp=$(OUT)/cross/%.o)

unit: $(UNIT)
compile: $(COMPILE)
list-unit:
	@printf '%s\n' $(UNIT)
list-compile:
	@printf '%s\n' $(COMPILE)
.PHONY: unit compile list-unit list-compile
.DELETE_ON_ERROR:
.SECONDARY:

# PlainCoreTest lives on the plainer core, all others on the board's.
$(OUT)/unit/%Test: $(OUT)/unit/%Test.o $(OUT)/unit/Main.o $(OUT)/board.a
	$(CXX) $(SANITIZE) $^ -lrapidcheck -o $@
$(OUT)/unit/PlainCoreTest: $(OUT)/unit/PlainCoreTest.o $(OUT)/unit/Main.o $(OUT)/plain.a
	$(CXX) $(SANITIZE) $^ -o $@
# PreemptTest stops behind each instruction of the library: as the board has them, without the sanitizers' own.
$(OUT)/unit/PreemptTest: SANITIZE :=
$(OUT)/unit/PreemptTest: unit/PreemptTest.cpp unit/Main.cpp unit/FakeClock.cpp $(SOURCES:%=$(SRC)/%) build.mk
	@mkdir -p $(@D)
	for source in $(SOURCES:%=$(SRC)/%); do \
	  $(CXX) $(BOARD) $(WARNINGS) -g -Os -MMD -MP -I$(SRC) $(ARDUINO) -c $$source -o $@.$$(basename $$source .cpp).o || exit 1; done
	$(CXX) -std=c++17 $(WARNINGS) -g -Os -MMD -MP -MT $@ -MF $@.d -Iunit -I$(SRC) -I$(HOST) $(ARDUINO) \
	  unit/PreemptTest.cpp unit/Main.cpp unit/FakeClock.cpp $(HOST)/arduino/Print.cpp $@.*.o -o $@

$(OUT)/unit/%.o: unit/%.cpp build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(WARNINGS) $(SANITIZE) $(DEBUG) $(DEPENDENCIES) $(PLAIN) -Iunit -I$(SRC) -I$(HOST) $(ARDUINO) -c $< -o $@
$(OUT)/unit/PlainCoreTest.o: PLAIN := -DHOST_PLAIN_CORE

# The library, Arduino's Print and the fake clock; an archive, so that a program takes what it uses and nothing else.
compile_board = $(CXX) $1 $(WARNINGS) $(SANITIZE) $(DEBUG) $(DEPENDENCIES) -I$(SRC) $(ARDUINO) -c $< -o $@

# What the fakes derive from needs RTTI, as they have it themselves; the library does without, as on the board.
define archive
$(OUT)/$1/src/%.o: $(SRC)/%.cpp build.mk
	@mkdir -p $$(@D)
	$$(call compile_board,$(BOARD) $2)
$(OUT)/$1/arduino/%.o: $(HOST)/arduino/%.cpp build.mk
	@mkdir -p $$(@D)
	$$(call compile_board,-std=gnu++11 $2)
$(OUT)/$1/runtime/%.o: $(HOST)/runtime/%.cpp build.mk
	@mkdir -p $$(@D)
	$$(call compile_board,-std=c++17)
$(OUT)/$1/FakeClock.o: unit/FakeClock.cpp build.mk
	@mkdir -p $$(@D)
	$$(call compile_board,-std=gnu++11 $2)
$(OUT)/$1.a: $(SOURCES:%.cpp=$(OUT)/$1/src/%.o) $(ARDUINO_SOURCES:%.cpp=$(OUT)/$1/arduino/%.o) \
  $(RUNTIME_SOURCES:%.cpp=$(OUT)/$1/runtime/%.o) $(OUT)/$1/FakeClock.o
	@rm -f $$@
	ar rcs $$@ $$^
endef
$(eval $(call archive,board))
$(eval $(call archive,plain,-DHOST_PLAIN_CORE))

# The torture bench, fast, and a second time under the sanitizers. OUT/VARIANT/TortureTest holds the bounds,
# OUT/VARIANT/Torture prints the table.
LINE_PARTS := Bench Conditions Judge Sticks WireLine
LINE_INCLUDES := -Iline -Iunit -I$(SRC) -I$(HOST) $(ARDUINO)
define line_rule
$(OUT)/$1/%.o: $3/%.cpp build.mk
	@mkdir -p $$(@D)
	$(CXX) -std=c++17 $(WARNINGS) $2 $$(DEPENDENCIES) $(LINE_INCLUDES) -c $$< -o $$@

endef
define line
$(OUT)/$1/src/%.o: $(SRC)/%.cpp build.mk
	@mkdir -p $$(@D)
	$(CXX) $(BOARD) $(WARNINGS) $2 $$(DEPENDENCIES) -I$(SRC) $(ARDUINO) -c $$< -o $$@
$(foreach folder,line unit $(HOST)/runtime $(HOST)/arduino,$(call line_rule,$1,$2,$(folder)))
$(OUT)/$1/TortureTest: $(OUT)/$1/Main.o
$(OUT)/$1/Torture $(OUT)/$1/TortureTest: $(OUT)/$1/%: $(OUT)/$1/%.o $(LINE_PARTS:%=$(OUT)/$1/%.o) \
  $(SOURCES:%.cpp=$(OUT)/$1/src/%.o) $(OUT)/$1/BoardUart.o $(OUT)/$1/FakeClock.o $(OUT)/$1/Print.o
	$(CXX) $2 $$^ -o $$@
endef
$(eval $(call line,line,-O2))
$(eval $(call line,line-sanitized,$(SANITIZE) $(DEBUG)))

# No include path: the core may include its own folder and the C library, never Arduino.h.
$(OUT)/alone/%.ok: $(SRC)/% build.mk
	@mkdir -p $(@D)
	$(CXX) $(BOARD) $(WARNINGS) $(DEPENDENCIES) -fsyntax-only -x c++ -include $< /dev/null
	@touch $@
$(OUT)/macros/%.o: $(SRC)/%.cpp compile/ArduinoMacros.h build.mk
	@mkdir -p $(@D)
	$(CXX) $(BOARD) $(WARNINGS) $(DEPENDENCIES) -include compile/ArduinoMacros.h -c $< -o $@

cross = $(CROSS) $(BOARD) $(WARNINGS) -Os -mcpu=cortex-m0plus -mthumb $(DEPENDENCIES) $1 -c $< -o $@
$(OUT)/cross/sbus/%.o: $(SRC)/sbus/%.cpp build.mk
	@mkdir -p $(@D)
	$(call cross)
$(OUT)/cross/%.o: $(SRC)/%.cpp build.mk
	@mkdir -p $(@D)
	$(call cross,$(ARDUINO))

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)

# fuzz: libFuzzer's programs, OUT/fuzz/*, with clang's sanitizers; CXX must be clang++. `make list-fuzz` names them.
FUZZ := $(patsubst fuzz/%.cpp,$(OUT)/fuzz/%,$(wildcard fuzz/*.cpp))
FUZZ_SOURCES := $(CORE_SOURCES:%=$(SRC)/%) $(HOST)/runtime/Recording.cpp
fuzz: $(FUZZ)
list-fuzz:
	@printf '%s\n' $(FUZZ)
.PHONY: fuzz list-fuzz
$(OUT)/fuzz/%: fuzz/%.cpp $(FUZZ_SOURCES) $(CORE_HEADERS:%=$(SRC)/%) unit/BitByBit.h build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(WARNINGS) -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all $(DEBUG) \
	  -Iunit -I$(SRC) -I$(HOST) $(filter %.cpp,$^) -o $@

# captures: the program that replays a folder of recordings.
captures: $(OUT)/captures/Replay
.PHONY: captures
$(OUT)/captures/Replay.o: captures/Replay.cpp build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(WARNINGS) $(SANITIZE) $(DEBUG) $(DEPENDENCIES) -Iunit -I$(SRC) -I$(HOST) $(ARDUINO) -c $< -o $@
$(OUT)/captures/Replay: $(OUT)/captures/Replay.o $(OUT)/board.a
	$(CXX) $(SANITIZE) $^ -o $@
