# Cleave: settings
CC       ?= gcc
ARCH     ?= native
REAL     := double
PREFIX   ?= /usr/local
OPTIMISE ?= -O3
WARN     := -Wall -Wextra -Wshadow -Wno-unknown-pragmas
PACKAGES := hdf5 hwloc yaml-0.1
BUILD    ?= build
VERSION  := 0.1.0

CPPFLAGS += -Iinclude -Ikernels -D_GNU_SOURCE -DCLEAVE_VERSION='"$(VERSION)"'
CFLAGS   += -std=c11 $(OPTIMISE) -g -march=$(ARCH) -ffp-contract=fast -fno-math-errno -fno-trapping-math -fopenmp $(WARN)
LIBFLAGS  = $(shell pkg-config --cflags $(PACKAGES))
LIBS      = $(shell pkg-config --libs $(PACKAGES)) -lm

SOURCES  := $(wildcard src/*.c kernels/*.c)
BENCHES  := $(wildcard bench/*.c)
TESTS    := $(wildcard tests/test_*.c)
OBJECTS  := $(SOURCES:%.c=$(BUILD)/%.o)
BENCHOBJ := $(BENCHES:%.c=$(BUILD)/%.o)
ENGINE   := $(filter-out $(BUILD)/src/main.o,$(OBJECTS))

all: $(BUILD)/cleave

$(BUILD)/cleave: $(OBJECTS) $(BENCHOBJ)
	$(CC) $(CFLAGS) -o $@ $^ $(LIBS)

$(BUILD)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(CC) $(CPPFLAGS) $(CFLAGS) $(LIBFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(ENGINE)
	$(CC) $(CFLAGS) -o $@ $^ -lcmocka $(LIBS)

-include $(wildcard $(BUILD)/*/*.d)
