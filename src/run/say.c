/* Warns how the plasticity of bodies with yielding bonds differs from von Mises plasticity. */
#include "run/say.h"

/* Strengths of bodies whose bonds yield individually, relative to von Mises plasticity without hardening [1], for each
 * space. pull, shear: in tension and in shear; across: ratio of lateral to axial plastic strain. Derivation, with the
 * yield stress sigma_y, Young's modulus E and the yield stretch s_y = sigma_y/E of a bond: bonds of each direction
 * carry K s_y per unit angle, in tension within an angle a of the load, in compression beyond; zero lateral stress
 * determines a. Plane stress: a - sin(2a)/2 = pi/4, sigma = K s_y (2a + sin(2a) - pi/2), K = 3E/pi. Plane strain: 16/15
 * of this value, relative to 2/sqrt(3) sigma_y. 3D: c - c^3/3 = 1/3 for c = cos a, sigma = 2 (1 - 2 c^3) sigma_y.
 * Shear: mean over the same bonds, relative to sigma_y/sqrt(3). across = cot(a)^2. */
static const struct {
    const char *body;
    real pull, shear, across;
} bonds_bear[] = {[SPACE_LINE] = {"bar", 1, 1, 0},
                  [SPACE_PLANE_STRESS] = {"plate", 1.41, 1.65, 0.20},
                  [SPACE_PLANE_STRAIN] = {"plate in plane strain", 1.30, 1.76, 0.20},
                  [SPACE_SOLID] = {"solid", 1.83, 2.21, 0.14}};

void warn_that_bond_plasticity_is_not_von_mises(const struct scene *s, struct warnings *warning_list)
{
    for (int m = 0; m < s->materials && s->method != METHOD_MPM && s->dim > 1; m++)
        if (material_yields(&s->material[m]))
            warnings_add_if_new(
                warning_list,
                "material %s: its bonds%s yield one by one, so this plasticity is approximate: a %s yields at about "
                "%.2f times yield_stress in tension and %.2f times the von Mises value in shear, and its lateral "
                "plastic strain is %.2f of the axial one; with method: mpm these figures are exact (1, 1 and %s)",
                s->material[m].name, s->method == METHOD_PD ? "" : ", to which points convert,",
                bonds_bear[s->space].body, bonds_bear[s->space].pull, bonds_bear[s->space].shear,
                bonds_bear[s->space].across, s->space == SPACE_PLANE_STRAIN ? "1" : "0.5");
}
