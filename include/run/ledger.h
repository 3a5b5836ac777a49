/* Room `run`: what all parts of a run share. It knows scenes, particles, bonds and loads, but no part; the parts, the
 * step and the engine call it.
 *
 * The energies of a run, one a row, and the work done on it. */
#ifndef CLEAVE_LEDGER
#define CLEAVE_LEDGER

#include "base/base.h"

/* X(name, colour, column) for each energy [J]: its name in history.csv, summary.json and struct energy, its colour in
 * pictures (Okabe & Ito 2008, and greys for what leaves), its column in history.csv. Sums run in this order. A new
 * energy is a row here, and its value in sample_energies (sample.c).
 *
 *     kinetic    1/2 m v_before . v_after of the velocity update
 *     strain     of bonds and material points
 *     plastic    work of their flow
 *     fracture   of bonds broken
 *     contact    of pairs in contact (contact.h)
 *     damped     taken by damping, friction and conversion
 *     absorbed   left through absorbing faces (loads/absorbing.h)
 *     viscous    taken by bulk viscosity (step/viscosity.h) */
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

/* Energies by name, and the same by row [J]. */
struct energy {
    union {
        struct {
            ENERGY_ROWS(ENERGY_MEMBER)
        };
        real of[ENERGIES];
    };
};

/* `name`: of the column and the figure; `label`: the same in words. */
struct ledger_row {
    const char *name, *label, *colour;
    int column;
};
/* The energies, and behind them the work of loads and supports. */
enum { LEDGER_WORK = ENERGIES, LEDGER_ROWS };
extern const struct ledger_row ledger[LEDGER_ROWS];

/* Sum of all energies, and of their sizes [J]. */
real energy_sum(const struct energy *u);
real energy_size(const struct energy *u);

#endif
