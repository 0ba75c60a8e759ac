# Builds the tests that run on this PC, in one of two variants, into the folder OUT (absolute):
#   VARIANT=plain       g++ -O1: `make test`
#   VARIANT=sanitized   clang++ -O2 with AddressSanitizer and UBSan: g++ takes twice as long to compile this at -O1
# SRC is the library, another copy than the repository's for impairment/without.sh.
# The targets:
#   host      OUT/sketches, the library and all of extras/host and extras/line, by extras/host's own Makefile. The others take
#             its objects: make it first, in a call of its own
#   sketch    OUT/sketches/NAME, the sketch SKETCH=folder
#   unit      OUT/UnitTest (unit/*Test.cpp), OUT/HostTest (host/*Test.cpp), and OUT/PreemptTest with a library of its own
#   lines     OUT/impairment/ImpairmentTest; OUT/impairment/Impairment prints the table
#   captures  OUT/captures/Replay
#   fuzz      OUT/fuzz/*, libFuzzer's programs, with clang's sanitizers; `make list-fuzz` names them
#   compile   what only has to compile: OUT/alone/*.ok, each header of the core, and the lines, without Arduino or board;
#             OUT/cross/*.o, the library for the board's processor (by CROSS, not CXX); and what must not,
#             OUT/Arrays.rejected. `make list-compile` names these

SRC := ../src
EXTRAS := ../extras
HOST := $(EXTRAS)/host
CROSS ?= arm-none-eabi-g++
VARIANT ?= plain

include $(EXTRAS)/setup/flags.mk
CXX_plain := g++
FLAGS_plain := -O1
CXX_sanitized := clang++
FLAGS_sanitized := -g -O2 $(SANITIZE)
CXX := $(CXX_$(VARIANT))
FLAGS := $(FLAGS_$(VARIANT))

ARDUINO := -I$(HOST)/arduino -I$(HOST)/standin
INCLUDES := -I. -I$(SRC) -I$(HOST) -I$(EXTRAS) $(ARDUINO)
BOARDS = $(BOARD) $(WARNINGS) $(DEPENDENCIES) $(INCLUDES)
PCS = -std=c++17 $(WARNINGS) $(DEPENDENCIES) $(INCLUDES)

CORE_SOURCES := $(patsubst $(SRC)/%,%,$(wildcard $(SRC)/sbus*/*.cpp))
CORE_HEADERS := $(patsubst $(SRC)/%,%,$(wildcard $(SRC)/sbus*/*.h))
SOURCES := $(CORE_SOURCES) $(patsubst $(SRC)/%,%,$(wildcard $(SRC)/*.cpp))
LINE_SOURCES := $(patsubst $(EXTRAS)/%,%,$(wildcard $(EXTRAS)/line/*.cpp $(EXTRAS)/line/*/*.cpp))

.DELETE_ON_ERROR:
.SECONDARY:

build_host = +@$(MAKE) --no-print-directory -C $(HOST) SRC='$(abspath $(SRC))' BUILD='$(OUT)/sketches' CXX='$(CXX)' CXXFLAGS='$(FLAGS)'
host:
	$(build_host) objects left_out=
sketch:
	$(build_host) SKETCH='$(SKETCH)'

# An archive, so that a program takes what it uses and nothing else: the ports and the clock are fakes. Of arduino only
# what a HardwareSerial is made of.
HOST_OBJECTS := $(SOURCES:%.cpp=src/%.o) $(LINE_SOURCES:%.cpp=%.o) arduino/Print.o \
  $(addprefix board/,BoardUart.o BoardPort.o PortSettings.o Sender.o)
$(OUT)/board.a: $(HOST_OBJECTS:%=$(OUT)/sketches/objects/%)
	@rm -f $@
	ar rcs $@ $^

PROGRAMS := UnitTest HostTest PreemptTest
unit: $(PROGRAMS:%=$(OUT)/%)
lines: $(OUT)/impairment/ImpairmentTest
captures: $(OUT)/captures/Replay
.PHONY: host sketch unit lines captures

$(OUT)/%.o: %.cpp build.mk
	@mkdir -p $(@D)
	$(CXX) $(PCS) $(FLAGS) -c $< -o $@

link = $(CXX) $(FLAGS) $(filter %.o,$^) $(filter %.a,$^) -o $@
objects = $(patsubst %.cpp,$(OUT)/%.o,$(wildcard $1))
$(OUT)/UnitTest: $(filter-out $(OUT)/unit/Preempt%.o,$(call objects,unit/*Test.cpp))
# A line as the impairment bench has it.
$(OUT)/HostTest: $(call objects,host/*Test.cpp impairment/ImpairedLine.cpp impairment/Payload.cpp)
$(OUT)/UnitTest $(OUT)/HostTest: $(call objects,support/Main.cpp support/FakeClock.cpp) $(OUT)/board.a
	$(link)

$(OUT)/impairment/Impairment $(OUT)/impairment/ImpairmentTest: $(OUT)/support/FakeClock.o $(OUT)/board.a \
  $(filter-out $(OUT)/impairment/Impairment.o $(OUT)/impairment/ImpairmentTest.o,$(call objects,impairment/*.cpp))
$(OUT)/impairment/ImpairmentTest: $(OUT)/support/Main.o
$(OUT)/impairment/Impairment $(OUT)/impairment/ImpairmentTest: %: %.o
	$(link)

$(OUT)/captures/Replay: $(OUT)/captures/Replay.o $(OUT)/support/FakeClock.o $(OUT)/board.a
	$(link)

# PreemptTest stops after each instruction of the library: as the board has them, without the sanitizers' own.
PREEMPT := -g -Os
$(OUT)/Preempt/src/%.o: $(SRC)/%.cpp build.mk
	@mkdir -p $(@D)
	$(CXX) $(BOARDS) $(PREEMPT) -c $< -o $@
$(OUT)/Preempt/Print.o: $(HOST)/arduino/Print.cpp build.mk
	@mkdir -p $(@D)
	$(CXX) $(PCS) $(PREEMPT) -c $< -o $@
$(OUT)/Preempt/%.o: %.cpp build.mk
	@mkdir -p $(@D)
	$(CXX) $(PCS) $(PREEMPT) -c $< -o $@
$(OUT)/PreemptTest: $(addprefix $(OUT)/Preempt/,$(patsubst %.cpp,%.o,$(wildcard unit/Preempt*Test.cpp)) support/Main.o support/FakeClock.o Print.o $(SOURCES:%.cpp=src/%.o))
	$(CXX) $(PREEMPT) $^ -o $@

# ---- What only has to compile

COMPILE := $(CORE_HEADERS:%=$(OUT)/alone/%.ok) $(LINE_SOURCES:%=$(OUT)/alone/%.ok) \
  $(SOURCES:%.cpp=$(OUT)/cross/%.o) $(OUT)/Arrays.rejected
compile: $(COMPILE)
list-compile:
	@printf '%s\n' $(COMPILE)
.PHONY: compile list-compile

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

# As a user builds, without warnings.
$(OUT)/Arrays.rejected: compile/Arrays.cpp $(wildcard $(SRC)/*.h $(SRC)/sbus*/*.h $(SRC)/port/*.h) build.mk
	@mkdir -p $(@D) && rm -f $@
	$(CXX) $(BOARD) $(INCLUDES) -DCASE=0 -include Arduino.h -fsyntax-only $<
	sed -n 's,^// \([1-9][0-9]*\) ,\1 ,p' $< | while read -r case text; do \
	  ! $(CXX) $(BOARD) $(INCLUDES) -DCASE=$$case -include Arduino.h -fsyntax-only $< 2>$@.said && \
	  grep -e 'error:' -e note: $@.said | grep "$$text" || exit; done >$@

cross = $(CROSS) $(shell $(EXTRAS)/setup/arm-specs.sh) $(BOARD) $(WARNINGS) -Os -mcpu=cortex-m0plus -mthumb $(DEPENDENCIES) $1 -c $< -o $@
$(OUT)/cross/sbus%.o: $(SRC)/sbus%.cpp build.mk
	@mkdir -p $(@D)
	$(call cross)
$(OUT)/cross/%.o: $(SRC)/%.cpp build.mk
	@mkdir -p $(@D)
	$(call cross,$(ARDUINO))

# ---- Fuzzing

FUZZ := $(call objects,fuzz/*.cpp)
FUZZ := $(FUZZ:.o=)
FUZZ_SOURCES := $(CORE_SOURCES:%=$(SRC)/%) $(addprefix $(EXTRAS)/line/,recording/CsvRows.cpp LineSettings.cpp recording/LateReads.cpp recording/Recording.cpp recording/RecordingReader.cpp recording/WallTime.cpp)
fuzz: $(FUZZ)
list-fuzz:
	@printf '%s\n' $(FUZZ)
.PHONY: fuzz list-fuzz
# Without what only reads files, for which libarchive would have to be linked.
$(OUT)/fuzz/WireFuzz: $(filter-out %/PackedFile.cpp,$(wildcard $(EXTRAS)/line/capture/*.cpp)) \
  $(addprefix $(EXTRAS)/line/,Decoders.cpp Observer.cpp Segments.cpp Statistics.cpp telemetry/TelemetrySlots.cpp)
$(OUT)/fuzz/FileFuzz: $(filter-out %/PackedFile.cpp,$(wildcard $(EXTRAS)/line/capture/*.cpp)) $(filter-out %/CaptureFile.cpp,$(wildcard $(EXTRAS)/line/file/*.cpp)) \
  $(addprefix $(EXTRAS)/line/,Decoders.cpp FrameBytes.cpp Observer.cpp recording/PlainText.cpp Segments.cpp Statistics.cpp telemetry/TelemetrySlots.cpp)
$(OUT)/fuzz/%: fuzz/%.cpp $(FUZZ_SOURCES) $(CORE_HEADERS:%=$(SRC)/%) $(wildcard support/*.h) build.mk
	@mkdir -p $(@D)
	clang++ -std=c++17 $(WARNINGS) -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -g -O1 \
	  $(INCLUDES) $(filter %.cpp,$^) -o $@

-include $(shell find $(OUT) -path $(OUT)/sketches -prune -o -name '*.d' -print 2>/dev/null)
