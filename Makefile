# Cleave: settings
CC       ?= gcc
ARCH     ?= native
OPTIMISE ?= -O3
PREFIX   ?= /usr/local
BUILD    ?= build
THREADS  ?= 2
VERSION  := 0.1.0
WARN     := -Wall -Wextra -Wshadow -Wno-unknown-pragmas -Wno-psabi
LIBRARIES := hdf5 hwloc yaml-0.1

CPPFLAGS += -Iinclude -Ikernels -Isrc -Ibench -D_GNU_SOURCE -DCLEAVE_VERSION='"$(VERSION)"'
CFLAGS   += -std=c11 $(OPTIMISE) -g -march=$(ARCH) -ffp-contract=fast -fno-math-errno -fno-trapping-math -fopenmp $(WARN)
LIBFLAGS  = $(shell pkg-config --cflags $(LIBRARIES))
LIBS      = $(shell pkg-config --libs $(LIBRARIES)) -lm

SOURCES  := $(wildcard src/*.c kernels/*.c bench/*.c)
TESTS    := $(wildcard tests/test_*.c)
OBJECTS  := $(SOURCES:%.c=$(BUILD)/%.o)
ENGINE   := $(filter-out $(BUILD)/src/main.o,$(OBJECTS))
PROGRAMS := $(TESTS:%.c=$(BUILD)/%)
SCRIPTS  := $(sort $(wildcard tests/test_*.sh))
LONG     := $(sort $(wildcard tests/long_*.sh))

.PHONY: all run test test-long bench install packages clean
.SECONDARY:

all: $(BUILD)/cleave

# Short lines unless V=1.
Q = $(if $(V),,@echo "  $(if $(filter %.o,$@),CC,LD)  $@";)

$(BUILD)/cleave: $(OBJECTS)
	$(Q)$(CC) $(CFLAGS) -o $@ $^ $(LIBS)

$(BUILD)/%.o: %.c Makefile
	@mkdir -p $(@D)
	$(Q)$(CC) $(CPPFLAGS) $(CFLAGS) $(LIBFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(ENGINE)
	$(Q)$(CC) $(CFLAGS) -o $@ $^ -lcmocka $(LIBS)

# The main job: installs what is missing, builds, breaks a steel plate, draws it.
run: packages
	@$(MAKE) --no-print-directory -j$$(getconf _NPROCESSORS_ONLN) all
	$(BUILD)/cleave run inputs/kalthoff_winkler.yaml
	$(BUILD)/cleave plot results/kalthoff_winkler

test: packages
	@$(MAKE) --no-print-directory -j$$(getconf _NPROCESSORS_ONLN) all $(PROGRAMS)
	@BUILD=$(BUILD) OMP_NUM_THREADS=$(THREADS) sh tests/run.sh $(PROGRAMS) $(SCRIPTS)

test-long: test
	@BUILD=$(BUILD) OMP_NUM_THREADS=$(THREADS) sh tests/run.sh $(LONG)

bench: all
	$(BUILD)/cleave bench kernels efficiency

install: all
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/man/man1
	install -m 755 $(BUILD)/cleave $(DESTDIR)$(PREFIX)/bin/cleave
	$(BUILD)/cleave help --manual > $(BUILD)/cleave.1
	install -m 644 $(BUILD)/cleave.1 $(DESTDIR)$(PREFIX)/share/man/man1/cleave.1

clean:
	rm -rf $(BUILD)

packages:
	@sh src/packages.sh

-include $(wildcard $(BUILD)/*/*.d)
