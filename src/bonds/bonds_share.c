/* Derives the properties that the eight bonds of a column have in common, so that force loops read one value instead of
 * eight. (A column contains the k-th bonds of the eight rows of a block, SELL-C layout.) */
#include <math.h>
#include <string.h>

#include "bonds_parts.h"
#include "base/memory.h"

/* Returns the bits of a as an integer. The integers of two adjacent floating-point numbers of one sign differ by 1. */
static int64_t bits_of(real a)
{
    int64_t bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}

void bonds_compute_lattice_shell_lengths(struct bonds *b, real spacing)
{
    b->shell_length = NEW("bonds.shell_length", BOND_SHELLS, struct bond_length);
    for (int k = 1; k < BOND_SHELLS; k++)
        b->shell_length[k] = (struct bond_length){1 / (spacing * sqrt(k)), spacing * sqrt(k), square(spacing) * k};
}

int eight_bonds_find_common_squared_lattice_distance(const struct bonds *b, const real *inverse_length,
                                                     int16_t *round_off_units)
{
    int one = 0;
    while (one < LANES - 1 && inverse_length[one] == 0) one++;
    const real squares = square(b->shell_length[1].inverse / inverse_length[one]);
    if (!(squares >= 0.5 && squares < BOND_SHELLS - 0.5)) return 0;
    const int lattice = (int)(squares + 0.5);
    const int64_t zero = bits_of(b->shell_length[lattice].inverse);
    int64_t outside = 0;
    for (int l = 0; l < LANES; l++) {
        const int64_t units = inverse_length[l] == 0 ? 0 : bits_of(fabs(inverse_length[l])) - zero;
        outside |= units != (int16_t)units;
        round_off_units[l] = (int16_t)units;
    }
    return outside ? 0 : lattice;
}

void bond_column_update_common_bond_properties(const struct bonds *b, int64_t column_number)
{
    const real *w = b->w + column_number * LANES;
    struct bond_column *c = &b->common[column_number];
    *c = (struct bond_column){.first = b->first[column_number], .begun = b->soft.curve ? c->begun : 0};
    if (c->first >= 0)
        c->shell = (uint8_t)eight_bonds_find_common_squared_lattice_distance(
            b, b->inverse_length + column_number * LANES, c->excess);
    c->alike = c->shell != 0;
    bool same = w[0] != 0;
    for (int l = 1; l < LANES; l++) same &= w[l] == w[0];
    if (same) { /* most columns */
        c->w = w[0], c->intact = UINT8_MAX;
        return;
    }
    for (int l = 0; l < LANES; l++) {
        if (w[l] == 0) continue;
        if (c->intact != 0 && w[l] != c->w) c->alike = 0;
        c->w = w[l];
        c->intact |= (uint8_t)(1 << l);
    }
}
