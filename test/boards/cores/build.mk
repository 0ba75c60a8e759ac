# Builds the library, the examples and README.md's sketch against the stand-ins of the cores' ports, into the folder OUT
# (absolute)
#   OUT/CORE/CoresTest     the program that runs frames through them, both ways, and Diagnose on them
#   OUT/CORE/SensorTest    an S.BUS2 sensor on them, where the core times it
#   OUT/CORE/PolledSensorTest  the same, where loop() times it, and on a single wire
#   OUT/CORE/BackgroundTest  DecodeSBusBackground on them, where the core can poll
#   OUT/CORE/PreemptBackgroundTest  the same, interrupted after each instruction
#   OUT/CORE/DmaSenderTest  what an STM32L0 sends by DMA
#   OUT/CORE/ReceiveOnlyTest  a sketch without that
#   OUT/CORE/TasksTest     the example Tasks on FreeRTOS, where the core has it
#   OUT/CORE/PpmOutTest    the example PpmOut, on a Pico's alarm and polled
#   OUT/CORE/JoystickTest  the example Joystick, where the core makes a USB joystick
#   OUT/CORE/NAME.ok       examples that compile
#   OUT/CORE/NAME.rejected  examples that say why they cannot run on this board, and what to do
#   OUT/CORE/SBusBoard.ok   SBUS_UART and SBUS_FREE_PINS are as boards.md says
#   OUT/stm32l0/Stm32L0.ok  the timer of an STM32L0, which no stand-in has, compiles
#   OUT/uno/NoServo.rejected  what the compiler says to Servos without the library Servo
#   OUT/CORE/SingleWire.rejected, NoBackground.rejected  what the compiler says to SingleWire.cpp, NoBackground.cpp
# `make list` names all of these.

HERE := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
ROOT := $(abspath $(HERE)/../../..)
HOST := $(ROOT)/extras/host

# The stand-in, its variant, and the core's C++ (platform.txt).
CORES := avr esp32-1.0 esp32-3.0 esp8266 megaavr nrf52 pico sam samd stm32 stm32f4 stm32l0 teensy32 teensy4 uno-r4
avr := Avr gnu++11
esp32-1.0 := Esp32 gnu++11 -DESP32_CORE=1
esp32-3.0 := Esp32 gnu++2b -DESP32_CORE=3
esp8266 := Esp8266 gnu++17
megaavr := MegaAvr gnu++11
nrf52 := Nrf52 gnu++11
pico := Pico gnu++2b
sam := Sam gnu++11 -DSERIAL_SBUS=Serial1  # as public sketches define it, and ArduinoCore-stm32wb
samd := Samd gnu++11
stm32 := Stm32 gnu++17
stm32f4 := Stm32 gnu++17 -DSTM32F4
stm32l0 := Stm32L0 gnu++11
teensy32 := Teensy32 gnu++17
teensy4 := Teensy4 gnu++17
uno-r4 := UnoR4 gnu++17

# Further boards: what is compiled there differs by SBusBoard.h alone, which a few examples show.
BOARDS := attiny attiny2 ch32v esp32-c3 esp32-c6 esp32-h2 esp32-p4 esp32-pico esp32-psram esp32-s2 esp32-s3 feather-m4 leonardo nano-esp32 nano33 stm32-nucleo stm32-no-usb stm32l0-0.0 uno xiao-esp32
attiny := MegaAvr gnu++17 -DMEGATINYCORE -DONE_PORT
attiny2 := MegaAvr gnu++17 -DMEGATINYCORE
ch32v := UnoR4 gnu++17 -DARDUINO_ARCH_CH32V
esp32-c3 := Esp32 gnu++2b -DESP32_CORE=3 -DCONFIG_IDF_TARGET_ESP32C3=1
esp32-c6 := Esp32 gnu++2b -DESP32_CORE=3 -DCONFIG_IDF_TARGET_ESP32C6=1
esp32-h2 := Esp32 gnu++2b -DESP32_CORE=3 -DCONFIG_IDF_TARGET_ESP32H2=1
esp32-p4 := Esp32 gnu++2b -DESP32_CORE=3 -DCONFIG_IDF_TARGET_ESP32P4=1
esp32-pico := Esp32 gnu++2b -DESP32_CORE=3 -DARDUINO_ESP32_PICO
esp32-psram := Esp32 gnu++2b -DESP32_CORE=3 -DBOARD_HAS_PSRAM
esp32-s2 := Esp32 gnu++2b -DESP32_CORE=3 -DCONFIG_IDF_TARGET_ESP32S2=1
esp32-s3 := Esp32 gnu++2b -DESP32_CORE=3 -DCONFIG_IDF_TARGET_ESP32S3=1
feather-m4 := Samd gnu++11 -DADAFRUIT_FEATHER_M4_EXPRESS
leonardo := Avr gnu++11 -D__AVR_ATmega32U4__
nano-esp32 := Esp32 gnu++2b -DESP32_CORE=3 -DCONFIG_IDF_TARGET_ESP32S3=1 -DARDUINO_NANO_ESP32
nano33 := UnoR4 gnu++14 -DARDUINO_ARDUINO_NANO33BLE
stm32-nucleo := Stm32 gnu++17 -DNUCLEO
stm32-no-usb := Stm32 gnu++17 -DNO_USB
stm32l0-0.0 := Stm32L0 gnu++11 -DSTM32L0_CORE_0_0
uno := Avr gnu++11 -DONE_PORT
xiao-esp32 := Esp32 gnu++2b -DESP32_CORE=3 -DCONFIG_IDF_TARGET_ESP32C3=1 -DARDUINO_XIAO_ESP32C3

# What an example says on a board that it cannot run on; empty: it compiles. $1: the board, $2: the example.
reason = $(strip $(if $(filter nano33 ch32v,$1),core cannot receive S.Bus,$(if $(filter esp32-p4,$1),define SBUS_UART Serial1, \
  $(if $(filter stm32-nucleo,$1),must make this board.s Serial1,$(if $(filter attiny esp8266 stm32-no-usb uno,$1), \
  $(if $(filter Led Servos,$2),,one port cannot receive and print),$(if $(filter leonardo-PwmIn,$1-$2),needs four pins with interrupts))))))
# How boards.md calls it, in the row of SBUS_UART and SBUS_FREE_PINS.
page = $(or $($1_page),$(if $(filter esp32-%,$1),ESP32,Serial1))
attiny_page := ATtiny 0, 1
attiny2_page := ATtiny 2
feather-m4_page := Feather
esp32-c3_page := ESP32-C3
esp32-c6_page := ESP32-C6
esp32-h2_page := ESP32-H2
esp32-pico_page := ESP32-PICO
esp32-psram_page := PSRAM
esp32-s2_page := ESP32-S2
esp32-s3_page := S3
esp8266_page := ESP8266
nano-esp32_page := Nano ESP32
uno_page := Pro Mini
xiao-esp32_page := XIAO ESP32

# One of each timer that polls each millisecond; boards/avr runs an AVR's.
TIMERS := pico esp32-3.0 samd teensy4
chip = $(or $(filter Rp2040,$(1:pico=Rp2040)),$(filter Esp32,$(1:esp32-3.0=Esp32)),$(filter Samd,$(1:samd=Samd)),Teensy)
ticks = $(or $(filter PicoAlarms,$(1:pico=PicoAlarms)),$(filter Esp32Task,$(1:esp32-3.0=Esp32Task)),Ticks)
# One of each USB joystick, and what its core defines where the board or the user's choice has it.
JOYSTICKS := avr esp32-3.0 pico teensy4
avr_usb := -DUSBCON
esp32-3.0_usb := -DCONFIG_TINYUSB_HID_ENABLED=1
teensy4_usb := -DJOYSTICK_INTERFACE=3

EXAMPLES := $(notdir $(wildcard $(ROOT)/examples/*))
# All of them where ports and headers differ most. On a board that has no port to print, those that tell; SBusBoard.ok says
# what else a board needs.
WHOLE := esp32-3.0 sam stm32l0 teensy4
examples = $(if $(filter $(WHOLE),$1),$(EXAMPLES),$(if $(call reason,$1,DecodeSBus),DecodeSBus Led Servos,$(if $(filter $(CORES),$1),DecodeSBus) \
  $(if $(filter leonardo,$1),PwmIn)))
compiled = $(foreach name,$(call examples,$1),$(name).$(if $(call reason,$1,$(name)),rejected,ok))
ALL := $(CORES:%=$(OUT)/%/CoresTest) $(addprefix $(OUT)/,pico/SensorTest esp32-3.0/SensorTest teensy4/PolledSensorTest \
  stm32l0/DmaSenderTest stm32l0-0.0/DmaSenderTest stm32l0/ReceiveOnlyTest stm32l0/Stm32L0.ok $(TIMERS:%=%/BackgroundTest) \
  teensy4/PreemptBackgroundTest esp32-3.0/TasksTest pico/PpmOutTest samd/PpmOutTest $(JOYSTICKS:%=%/JoystickTest) \
  stm32/SingleWire.rejected teensy4/SingleWire.rejected uno/NoServo.rejected \
  stm32/NoBackground.rejected pico/NoBackground.rejected teensy4/NoBackground.rejected) \
  $(foreach board,$(CORES) $(BOARDS),$(patsubst %,$(OUT)/$(board)/%,$(call compiled,$(board)) \
  $(if $(filter $(BOARDS) avr esp%,$(board)),$(if $(call reason,$(board),Led),,SBusBoard.ok))))

all: $(ALL)
list:
	@printf '%s\n' $(ALL)
.PHONY: all list
.DELETE_ON_ERROR:
.SECONDARY:

include $(ROOT)/extras/setup/flags.mk
FLAGS := $(WARNINGS) -I$(HERE) -I$(ROOT)/src -I$(HOST)/standin
TEST := -std=gnu++14 -O1 $(FLAGS) -I$(ROOT)/extras -I$(ROOT)/test
SBUS := $(patsubst $(ROOT)/src/%.cpp,$(OUT)/core/%.o,$(wildcard $(ROOT)/src/sbus*/*.cpp))

comma := ,
hash := \#
SIMULATION := $(addprefix simulation/,SimulatedBus SimulatedReceiver Choreography) LineSettings

# On the ESP8266 Serial1 only sends, so there Serial1 and Serial change places.
with_its_ports = $(if $(filter esp8266,$1),sed 's/Serial1/@/g; s/Serial/Serial1/g; s/@/Serial/g',cat)
# Headers of a core that are one here: NAME/HEADER includes WHAT.
name = $(shell [ -e $(OUT)/names/$1 ] || { mkdir -p $(dir $(OUT)/names/$1) && echo '$(hash)include "$2"' >$(OUT)/names/$1; })
$(foreach header,esp_attr.h esp_timer.h freertos/FreeRTOS.h freertos/semphr.h hal/uart_ll.h,$(call name,esp32/$(header),EspIdf.h))
$(foreach header,hardware/irq.h hardware/sync.h hardware/timer.h pico.h,$(call name,pico/$(header),PicoSdk.h))
$(foreach header,HID.h Joystick.h USB.h USBHID.h,$(call name,usb/$(header),Usb.h))
$(call name,esp32/ESP32Servo.h,$(HOST)/arduino/Servo.h)

# $1: the core. on%Pins.o is the example Diagnose, in a namespace of that name. The host's Servo.h serves all but the ESP32,
# which has ESP32Servo.h.
define core_rules
$1_core = $(if $(filter stm32l0%,$1),-I$(HERE)/stm32l0) -DCORE='"core/$(firstword $($1)).h"' $(wordlist 3,9,$($1)) $(if $(filter Esp32,$($1)),-I$(OUT)/names/esp32,-idirafter $(HOST)/arduino) $(if $(filter pico,$1),-I$(OUT)/names/pico -I$(OUT)/names/usb) $(if $(filter teensy%,$1),-I$(HERE)/teensy)
$1_board = $(BOARD:-std=%=-std=$(word 2,$($1))) $(FLAGS) $$($1_core)
$(OUT)/$1/CoresTest: $(OUT)/$1/CoresTest.o $(OUT)/$1/ReopenTest.o $(OUT)/$1/TransmitTest.o $(OUT)/$1/onCorePins.o \
  $(if $(filter esp%,$1),$(OUT)/$1/onGivenPins.o) $(OUT)/$1/README.o \
  $(OUT)/Uart.o $(OUT)/Main.o $(SBUS)
	$(CXX) $$^ -o $$@
$(OUT)/$1/SensorTest: $(OUT)/$1/SensorTest.o $(OUT)/$1/$(if $(filter pico,$1),PicoAlarms,Esp32Task).o \
  $(OUT)/$1/SBus2Sensor.o $(addprefix $(OUT)/$1/port/timer/,PolledByTimer.o $(call chip,$1).o) $(OUT)/Uart.o $(OUT)/Main.o $(SIMULATION:%=$(OUT)/%.o) $(SBUS)
	$(CXX) $$^ -o $$@
$(OUT)/$1/DmaSenderTest: $(OUT)/$1/DmaSenderTest.o $(OUT)/Uart.o $(OUT)/Main.o
	$(CXX) $$^ -o $$@
$(OUT)/$1/ReceiveOnlyTest: $(OUT)/$1/ReceiveOnlyTest.o $(OUT)/Uart.o $(OUT)/Main.o $(SBUS)
	$(CXX) $$^ -o $$@
$(OUT)/$1/PolledSensorTest: $(OUT)/$1/PolledSensorTest.o $(OUT)/$1/SBus2Sensor.o $(OUT)/Uart.o \
  $(OUT)/Main.o $(SIMULATION:%=$(OUT)/%.o) $(SBUS)
	$(CXX) $$^ -o $$@
$(OUT)/$1/BackgroundTest: $(OUT)/$1/BackgroundTest.o $(OUT)/$1/PolledByTimerTest.o $(OUT)/$1/$(call ticks,$1).o \
  $(addprefix $(OUT)/$1/port/timer/,PolledByTimer.o $(call chip,$1).o) $(OUT)/Uart.o $(OUT)/Main.o $(SBUS)
	$(CXX) $$^ -o $$@
$(OUT)/$1/PreemptBackgroundTest: $(OUT)/$1/PreemptBackgroundTest.o $(OUT)/$1/Ticks.o \
  $(addprefix $(OUT)/$1/port/timer/,PolledByTimer.o $(call chip,$1).o) $(OUT)/Uart.o $(OUT)/Main.o $(SBUS)
	$(CXX) $$^ -o $$@
# The clock comes first: the sketch's objects read it before main().
$(OUT)/$1/TasksTest: $(OUT)/Uart.o $(OUT)/$1/TasksTest.o $(OUT)/$1/TasksSketch.o $(OUT)/Main.o $(SBUS)
	$(CXX) $$^ -o $$@
$(OUT)/$1/PpmOutTest: $(OUT)/Uart.o $(OUT)/$1/PpmOutTest.o $(if $(filter pico,$1),$(OUT)/$1/PicoAlarms.o) \
  $(OUT)/$1/PpmOutSketch.o $(OUT)/Main.o $(SBUS)
	$(CXX) $$^ -o $$@
$(OUT)/$1/TasksSketch.o $(OUT)/$1/PpmOutSketch.o: $(OUT)/$1/%Sketch.o: $(ROOT)/examples/%/ $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(CXX) $$($1_board) $$(DEPENDENCIES) -x c++ -include Arduino.h -c $(ROOT)/examples/$$*/$$*.ino -o $$@
$(OUT)/$1/JoystickTest: $(OUT)/Uart.o $(OUT)/$1/JoystickTest.o $(OUT)/Main.o $(SBUS)
	$(CXX) $$^ -o $$@
$(OUT)/$1/JoystickTest.o: $(HERE)/JoystickTest.cpp $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(CXX) $(TEST) $$($1_core) $$($1_usb) -I$(OUT)/names/usb $$(DEPENDENCIES) -c $$< -o $$@
$(addprefix $(OUT)/$1/,PicoAlarms.o Ticks.o Esp32Task.o): $(OUT)/$1/%.o: $(HERE)/%.cpp $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(CXX) $(TEST) $$($1_core) $$(DEPENDENCIES) -c $$< -o $$@
$(OUT)/$1/%Test.o: $(HERE)/%Test.cpp $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(CXX) $(TEST) $$($1_core) $$(DEPENDENCIES) -c $$< -o $$@
$(OUT)/$1/%.o: $(ROOT)/src/%.cpp $(HERE)/build.mk
	@mkdir -p $$(@D)
	$(CXX) $$($1_board) -O1 $$(DEPENDENCIES) -c $$< -o $$@
$(OUT)/$1/README.o: $(OUT)/README.cpp
	@mkdir -p $$(@D)
	$(call with_its_ports,$1) $$< | $(CXX) $$($1_board) $(if $(filter esp8266,$1),-DSBUS_MAY_TAKE_USB) $$(DEPENDENCIES) -x c++ -include Arduino.h -c - -o $$@
$(OUT)/$1/on%Pins.o: $(ROOT)/examples/Diagnose/Diagnose.ino $(HERE)/build.mk
	@mkdir -p $$(@D)
	(echo '#define SBUS_UART SBUS_PORT$$(if $$(filter Given,$$*),$$(comma) PINS_GIVEN)'; echo '#include <DecodeSBus.h>'; \
	  echo '#include <SBusBoard.h>'; echo '#include <DecodeSBusDiagnosis.h>'; echo 'namespace on$$*Pins {'; \
	  $(call with_its_ports,$1) $$<; echo '}') >$$(@:.o=.cpp)
	$(CXX) $$($1_board) $$(DEPENDENCIES) -include Arduino.h -c $$(@:.o=.cpp) -o $$@
$(OUT)/$1/%.ok: $(ROOT)/examples/%/ $(HERE)/build.mk
	@mkdir -p $$(@D) && rm -f $$@
	$(CXX) $$($1_board) $$(DEPENDENCIES) -x c++ -include Arduino.h -fsyntax-only $(ROOT)/examples/$$*/$$*.ino
	@touch $$@
$(OUT)/$1/%.rejected: $(ROOT)/examples/%/ $(HERE)/build.mk
	@mkdir -p $$(@D) && rm -f $$@
	! $(CXX) $$($1_board) $$(DEPENDENCIES) -x c++ -include Arduino.h -fsyntax-only $(ROOT)/examples/$$*/$$*.ino 2>$$@
	grep -m 1 'error' $$@ | grep 'DecodeSBus: \|$$* needs ' | grep -q '$$(call reason,$1,$$*)'
	[ $$$$(grep -c 'error' $$@) -eq $$$$(grep -c '#error' $$@) ]
$(OUT)/$1/SBusBoard.ok: $(ROOT)/src/SBusBoard.h $(ROOT)/extras/docs/boards.md $(HERE)/build.mk
	@mkdir -p $$(@D) && rm -f $$@
	echo '#include <SBusBoard.h>' | $(CXX) $$($1_board) -DSBUS_MAY_TAKE_USB -include Arduino.h -E -dM -x c++ - | \
	  sed -nE 's/^#define SBUS_(PINS|UART) (.*[^ ]) *$$$$/\1 \2/p' | sort -r | sed 's/[A-Z]* //' | tr '\n' '|' >$$@.is
	grep "^|.*$(call page,$1).* | \`$$$$(sed 's/|/` | `/; s/|$$$$/` |/' $$@.is)" $(ROOT)/extras/docs/boards.md >$$@
$(OUT)/$1/SingleWire.rejected: $(HERE)/SingleWire.cpp $(HERE)/build.mk
	@mkdir -p $$(@D) && rm -f $$@
	! $(CXX) $$($1_board) -include Arduino.h -fsyntax-only $$< 2>$$@
	grep 'error:' $$@ | grep -q 'This port has no single wire'
$(OUT)/$1/NoBackground.rejected: $(HERE)/NoBackground.cpp $(HERE)/build.mk
	@mkdir -p $$(@D) && rm -f $$@
	sed -n 's,^// \($(if $(filter $(TIMERS),$1),[1-9],0)\) ,\1 ,p' $$< | while read -r case text; do \
	  ! $(CXX) $$($1_board) -DCASE=$$$$case -include Arduino.h -fsyntax-only $$< 2>$$@.said && \
	  grep 'error:' $$@.said | grep "$$$$text" || exit; done >$$@
endef
$(foreach core,$(CORES) $(BOARDS),$(eval $(call core_rules,$(core))))

# The stand-in has no timers.
$(OUT)/stm32l0/Stm32L0.ok: $(ROOT)/src/port/timer/Stm32L0.cpp $(HERE)/build.mk
	@mkdir -p $(@D) && rm -f $@
	$(CXX) $(stm32l0_board) $(DEPENDENCIES) -DTIM7 -include Arduino.h -include stm32l0_dma.h -fsyntax-only $<
	@touch $@
$(OUT)/uno/NoServo.rejected: $(ROOT)/examples/Servos/Servos.ino $(HERE)/build.mk
	@mkdir -p $(@D) && rm -f $@
	! $(CXX) $(subst -idirafter $(HOST)/arduino,,$(uno_board)) -x c++ -include Arduino.h -fsyntax-only $< 2>$@
	grep -A 1 'Servo.h: No such file' $@ | grep -q 'Install the library Servo from the Library Manager'

# The first sketch of README.md.
$(OUT)/README.cpp: $(ROOT)/README.md $(HERE)/build.mk
	@mkdir -p $(@D)
	awk '/^```$$/ && inside { exit } inside { print } /^```cpp$$/ { inside = 1 }' $< >$@
$(OUT)/Uart.o: $(HERE)/Uart.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(CXX) $(TEST) $(DEPENDENCIES) -c $< -o $@
$(SIMULATION:%=$(OUT)/%.o): $(OUT)/%.o: $(ROOT)/extras/line/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(FLAGS) -I$(ROOT)/extras -O1 $(DEPENDENCIES) -c $< -o $@
$(OUT)/Main.o: $(ROOT)/test/support/Main.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(DEPENDENCIES) -c $< -o $@
$(OUT)/core/%.o: $(ROOT)/src/%.cpp $(HERE)/build.mk
	@mkdir -p $(@D)
	$(CXX) $(BOARD) $(FLAGS) -O1 $(DEPENDENCIES) -c $< -o $@

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)
