/* Defines the table of the energies that the energy balance contains, and sums over its rows. */
#include "run/ledger.h"

#include <math.h>

#define LEDGER_ROW(name, colour, column) {#name, #name, colour, column},
const struct ledger_row ledger[LEDGER_ROWS] = {
    ENERGY_ROWS(LEDGER_ROW)[LEDGER_WORK] = {"external_work", "external work", "#000000", 6},
};

real energy_sum(const struct energy *u)
{
    real sum = u->of[0];
    for (int k = 1; k < ENERGIES; k++) sum += u->of[k];
    return sum;
}

real energy_sum_of_magnitudes(const struct energy *u)
{
    real sum = fabs(u->of[0]);
    for (int k = 1; k < ENERGIES; k++) sum += fabs(u->of[k]);
    return sum;
}
