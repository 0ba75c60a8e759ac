# Builds, with one compiler: CXX, into the folder OUT
#   unit      the unit programs, OUT/unit/*Test
#   compile   what only has to compile: OUT/alone/*.ok, each header of the core, and the lines, without Arduino or board;
#             OUT/macros/*.o, the core after Arduino's macros; OUT/cross/*.o, the library for the board's processor (by
#             CROSS, not CXX)
#   OUT/impairment/*, OUT/impairment-sanitized/*   the impairment bench
# `make list-unit` and `make list-compile` name what these two are made of.

SRC := ../src
HOST := ../extras/host
CROSS ?= arm-none-eabi-g++

include ../extras/setup/flags.mk
# g++ with the sanitizers; clang++ optimised, as users build it, in a quarter of the time.
ifeq ($(CXX),clang++)
SANITIZE :=
DEBUG := -g -O2
else
DEBUG := -g -O1
endif
EXTRAS := ../extras
ARDUINO := -I$(HOST)/arduino -I$(HOST)/standin
# Of the host: its rooms, and the lines.
ROOMS := -I. -I$(SRC) -I$(HOST) -I$(EXTRAS)

CORE_SOURCES := $(patsubst $(SRC)/%,%,$(wildcard $(SRC)/sbus/*.cpp))
CORE_HEADERS := $(patsubst $(SRC)/%,%,$(wildcard $(SRC)/sbus/*.h))
SOURCES := $(wildcard $(SRC)/*.cpp)
SOURCES := $(CORE_SOURCES) $(SOURCES:$(SRC)/%=%)
ARDUINO_SOURCES := Print.cpp  # what a HardwareSerial is made of; the ports themselves are fakes
# Of the host: how its board receives and sends.
HOST_SOURCES := board/BoardUart.cpp board/BoardTransmitter.cpp board/Port.cpp board/PortSettings.cpp board/PortWatch.cpp \
  board/Sender.cpp
LINE_SOURCES := $(patsubst $(EXTRAS)/%,%,$(wildcard $(EXTRAS)/line/*.cpp \
  $(addprefix $(EXTRAS)/line/,simulation/*.cpp recording/*.cpp uart/*.cpp capture/*.cpp telemetry/*.cpp ports/LowLatency.cpp)))

UNIT := $(patsubst %.cpp,$(OUT)/%,$(wildcard unit/*Test.cpp host/*Test.cpp))
COMPILE := $(CORE_HEADERS:%=$(OUT)/alone/%.ok) $(LINE_SOURCES:%=$(OUT)/alone/%.ok) \
  $(CORE_SOURCES:%.cpp=$(OUT)/macros/%.o) $(SOURCES:%.cpp=$(OUT)/cross/%.o)

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
$(OUT)/%Test: $(OUT)/%Test.o $(OUT)/support/Main.o $(OUT)/board.a
	$(CXX) $(SANITIZE) $^ -lrapidcheck -o $@
$(OUT)/unit/PlainCoreTest: $(OUT)/unit/PlainCoreTest.o $(OUT)/support/Main.o $(OUT)/plain.a
	$(CXX) $(SANITIZE) $^ -o $@
# A line as the impairment bench has it.
$(OUT)/host/AdapterTest $(OUT)/host/PortReadsTest: $(OUT)/support/ImpairedLine.o $(OUT)/support/Payload.o
# PreemptTest stops after each instruction of the library: as the board has them, without the sanitizers' own.
$(OUT)/unit/PreemptTest: SANITIZE :=
$(OUT)/unit/PreemptTest: unit/PreemptTest.cpp support/Main.cpp support/FakeClock.cpp $(SOURCES:%=$(SRC)/%) build.mk
	@mkdir -p $(@D)
	for source in $(SOURCES:%=$(SRC)/%); do \
	  $(CXX) $(BOARD) $(WARNINGS) -g -Os -MMD -MP -I$(SRC) $(ARDUINO) -c $$source -o $@.$$(basename $$source .cpp).o || exit 1; done
	$(CXX) -std=c++17 $(WARNINGS) -g -Os -MMD -MP -MT $@ -MF $@.d $(ROOMS) $(ARDUINO) \
	  unit/PreemptTest.cpp support/Main.cpp support/FakeClock.cpp $(HOST)/arduino/Print.cpp $@.*.o -o $@

define program
$(OUT)/$1/%.o: $1/%.cpp build.mk
	@mkdir -p $$(@D)
	$$(CXX) -std=c++17 $$(WARNINGS) $$(SANITIZE) $$(DEBUG) $$(DEPENDENCIES) $$(PLAIN) $$(ROOMS) $$(ARDUINO) -c $$< -o $$@
endef
$(foreach folder,unit host support,$(eval $(call program,$(folder))))
$(OUT)/support/%.o: impairment/%.cpp build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(WARNINGS) $(SANITIZE) $(DEBUG) $(DEPENDENCIES) -Iimpairment $(ROOMS) $(ARDUINO) -c $< -o $@
$(OUT)/unit/PlainCoreTest.o: PLAIN := -DHOST_PLAIN_CORE

# The library, Arduino's Print and the fake clock; an archive, so that a program takes what it uses and nothing else.
compile_board = $(CXX) $1 $(WARNINGS) $(SANITIZE) $(DEBUG) $(DEPENDENCIES) $(ROOMS) $(ARDUINO) -c $< -o $@

# What the fakes derive from needs RTTI, as they have it themselves; the library does without, as on the board.
define archive
$(OUT)/$1/src/%.o: $(SRC)/%.cpp build.mk
	@mkdir -p $$(@D)
	$$(call compile_board,$(BOARD) $2)
$(OUT)/$1/arduino/%.o: $(HOST)/arduino/%.cpp build.mk
	@mkdir -p $$(@D)
	$$(call compile_board,-std=gnu++11 $2)
$(OUT)/$1/board/%.o: $(HOST)/board/%.cpp build.mk
	@mkdir -p $$(@D)
	$$(call compile_board,-std=c++17)
$(OUT)/$1/line/%.o: $(EXTRAS)/line/%.cpp build.mk
	@mkdir -p $$(@D)
	$$(call compile_board,-std=c++17)
$(OUT)/$1/FakeClock.o: support/FakeClock.cpp build.mk
	@mkdir -p $$(@D)
	$$(call compile_board,-std=gnu++11 $2)
$(OUT)/$1.a: $(SOURCES:%.cpp=$(OUT)/$1/src/%.o) $(ARDUINO_SOURCES:%.cpp=$(OUT)/$1/arduino/%.o) \
  $(HOST_SOURCES:%.cpp=$(OUT)/$1/%.o) $(LINE_SOURCES:%.cpp=$(OUT)/$1/%.o) $(OUT)/$1/FakeClock.o
	@rm -f $$@
	ar rcs $$@ $$^
endef
$(eval $(call archive,board))
$(eval $(call archive,plain,-DHOST_PLAIN_CORE))

# The impairment bench, fast, and a second time under the sanitizers. OUT/VARIANT/ImpairmentTest holds the bounds,
# OUT/VARIANT/Impairment prints the table.
LINE_PARTS := Company Conditions ImpairedLine Joins Judge Payload Setup Simulation
LINE_INCLUDES := -Iimpairment $(ROOMS) $(ARDUINO) $(WITHOUT:%=-DSBUS_WITHOUT=%)
define line_rule
$(OUT)/$1/%.o: $3/%.cpp build.mk
	@mkdir -p $$(@D)
	$(CXX) -std=c++17 $(WARNINGS) $2 $$(DEPENDENCIES) $(LINE_INCLUDES) -c $$< -o $$@

endef
define line
$(OUT)/$1/src/%.o: $(SRC)/%.cpp build.mk
	@mkdir -p $$(@D)
	$(CXX) $(BOARD) $(WARNINGS) $2 $$(DEPENDENCIES) $(LINE_INCLUDES) -c $$< -o $$@
$(foreach folder,impairment support $(EXTRAS)/line/simulation $(HOST)/board $(HOST)/arduino,$(call line_rule,$1,$2,$(folder)))
$(OUT)/$1/ImpairmentTest: $(OUT)/$1/Main.o
$(OUT)/$1/Impairment $(OUT)/$1/ImpairmentTest: $(OUT)/$1/%: $(OUT)/$1/%.o $(LINE_PARTS:%=$(OUT)/$1/%.o) \
  $(SOURCES:%.cpp=$(OUT)/$1/src/%.o) $(OUT)/$1/BoardUart.o $(OUT)/$1/LineSettings.o $(OUT)/$1/FakeClock.o $(OUT)/$1/Print.o
	$(CXX) $2 $$^ -o $$@
endef
$(eval $(call line,impairment,-O2))
$(eval $(call line,impairment-sanitized,$(SANITIZE) $(DEBUG)))

# The lines know the core, and no Arduino, no board.
$(OUT)/alone/line/%.ok: $(EXTRAS)/line/% build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(WARNINGS) $(DEPENDENCIES) -I$(SRC) -I$(EXTRAS) -fsyntax-only $<
	@touch $@
# No include path: the core may include its own folder and the C library, never Arduino.h.
$(OUT)/alone/%.ok: $(SRC)/% build.mk
	@mkdir -p $(@D)
	$(CXX) $(BOARD) $(WARNINGS) $(DEPENDENCIES) -fsyntax-only -x c++ -include $< /dev/null
	@touch $@
$(OUT)/macros/%.o: $(SRC)/%.cpp compile/ArduinoMacros.h build.mk
	@mkdir -p $(@D)
	$(CXX) $(BOARD) $(WARNINGS) $(DEPENDENCIES) -include compile/ArduinoMacros.h -c $< -o $@

cross = $(CROSS) $(shell ../extras/setup/arm-specs.sh) $(BOARD) $(WARNINGS) -Os -mcpu=cortex-m0plus -mthumb $(DEPENDENCIES) $1 -c $< -o $@
$(OUT)/cross/sbus/%.o: $(SRC)/sbus/%.cpp build.mk
	@mkdir -p $(@D)
	$(call cross)
$(OUT)/cross/%.o: $(SRC)/%.cpp build.mk
	@mkdir -p $(@D)
	$(call cross,$(ARDUINO))

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)

# fuzz: libFuzzer's programs, OUT/fuzz/*, with clang's sanitizers; CXX must be clang++. `make list-fuzz` names them.
FUZZ := $(patsubst fuzz/%.cpp,$(OUT)/fuzz/%,$(wildcard fuzz/*.cpp))
FUZZ_SOURCES := $(CORE_SOURCES:%=$(SRC)/%) $(addprefix $(EXTRAS)/line/,recording/CsvRows.cpp simulation/LineSettings.cpp recording/Recording.cpp)
fuzz: $(FUZZ)
list-fuzz:
	@printf '%s\n' $(FUZZ)
.PHONY: fuzz list-fuzz
# Without what only reads files, for which libarchive would have to be linked.
$(OUT)/fuzz/Wire: $(filter-out %/CaptureFile.cpp %/PackedFile.cpp,$(wildcard $(EXTRAS)/line/capture/*.cpp)) \
  $(addprefix $(EXTRAS)/line/,Decoders.cpp uart/Levels.cpp Observer.cpp Segments.cpp Statistics.cpp telemetry/TelemetrySlots.cpp)
$(OUT)/fuzz/%: fuzz/%.cpp $(FUZZ_SOURCES) $(CORE_HEADERS:%=$(SRC)/%) support/BitByBit.h build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(WARNINGS) -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -g -O1 \
	   $(ROOMS) $(filter %.cpp,$^) -o $@

# captures: the program that replays a folder of recordings.
captures: $(OUT)/captures/Replay
.PHONY: captures
$(OUT)/captures/Replay.o: captures/Replay.cpp build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(WARNINGS) $(SANITIZE) $(DEBUG) $(DEPENDENCIES) $(ROOMS) $(ARDUINO) -c $< -o $@
$(OUT)/captures/Replay: $(OUT)/captures/Replay.o $(OUT)/board.a
	$(CXX) $(SANITIZE) $^ -o $@
