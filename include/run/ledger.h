/* Room `run` (folders include/run and src/run): data and functions that all parts of a run share; parts are contact,
 * probes and others. It uses scenes, particles, bonds and loads, but no part. The parts, the time step and the engine
 * use it.
 *
 * This header: the table of the energies of a run, and of the work done on the run. */
#ifndef CLEAVE_LEDGER
#define CLEAVE_LEDGER

#include "base/base.h"

/* X(name, colour, column) for each energy [J]: its name in history.csv, summary.json and struct energy; its colour in
 * pictures (Okabe & Ito 2008, greys for energies that leave the body); its column in history.csv. Sums are taken in
 * this order. A new energy needs a row here and its value in sample_energies (sample.c).
 *
 *     kinetic    1/2 m v_old . v_new of the velocity update
 *     strain     of bonds and material points
 *     plastic    plastic work of bonds and material points
 *     fracture   of broken bonds
 *     contact    of pairs in contact (contact.h)
 *     damped     dissipated by damping, friction and conversion
 *     absorbed   lost through absorbing faces (loads/absorbing.h)
 *     viscous    dissipated by bulk viscosity (step/viscosity.h) */
#define ENERGY_ROWS(X)                                                                                                 \
    X(kinetic, "#0072b2", 2)                                                                                           \
    X(strain, "#009e73", 3)                                                                                            \
    X(plastic, "#e69f00", 4)                                                                                           \
    X(fracture, "#d55e00", 5)                                                                                          \
    X(contact, "#cc79a7", 22)                                                                                          \
    X(damped, "#56b4e9", 19)                                                                                           \
    X(absorbed, "#999999", 23)                                                                                         \
    X(viscous, "#f0e442", 24)

#define ENERGY_COUNT(name, colour, column) +1
#define ENERGY_MEMBER(name, colour, column) real name;
enum { ENERGIES = ENERGY_ROWS(ENERGY_COUNT) };

/* The energies of a run [J], each accessible by its name in ENERGY_ROWS or by its number there, of[k]. */
struct energy {
    union {
        struct {
            ENERGY_ROWS(ENERGY_MEMBER)
        };
        real of[ENERGIES];
    };
};

/* A row of the energy balance: one energy, or the work of loads and supports. name: of the column in history.csv and
 * the key in summary.json; label: name in words; colour: in pictures; column: its number in history.csv. */
struct ledger_row {
    const char *name, *label, *colour;
    int column;
};

/* Rows of the energy balance: number k < ENERGIES is energy k of ENERGY_ROWS, LEDGER_WORK the work of loads and
 * supports. */
enum { LEDGER_WORK = ENERGIES, LEDGER_ROWS };
extern const struct ledger_row ledger[LEDGER_ROWS];

/* Returns the sum of all energies in *u [J], added in the order of ENERGY_ROWS. */
real energy_sum(const struct energy *u);

/* Returns the sum of the absolute values of all energies in *u [J]. Errors of the energy balance are compared with this
 * sum. */
real energy_sum_of_magnitudes(const struct energy *u);

#endif
