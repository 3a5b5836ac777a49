/* Warns how bonds that yield differ from von Mises' law. */
#include "run/say.h"

/* What a body of bonds bears that yield one by one, over von Mises' law, without hardening: bonds of all directions
 * carry K s_y each per angle, stretched within an angle a of the pull and shortened beyond; sides without stress fix
 * a. Plane: a - sin(2a)/2 = pi/4, sigma = K s_y (2a + sin(2a) - pi/2), K = 3E/pi; in plane strain 16/15 of it beside
 * a limit of 2/sqrt(3) sigma_y. Space: c - c^3/3 = 1/3 for c = cos a, sigma = 2 (1 - 2 c^3) sigma_y. Shear: the mean
 * of the same bonds beside sigma_y/sqrt(3). across: cot(a)^2, the ratio of plastic strains. */
static const struct {
    const char *body;
    real pull, shear, across;
} bonds_bear[] = {[SPACE_LINE] = {"bar", 1, 1, 0},
                  [SPACE_PLANE_STRESS] = {"plate", 1.41, 1.65, 0.20},
                  [SPACE_PLANE_STRAIN] = {"plate in plane strain", 1.30, 1.76, 0.20},
                  [SPACE_SOLID] = {"solid", 1.83, 2.21, 0.14}};

void warn_of_yielding(const struct scene *s, struct warnings *to)
{
    for (int m = 0; m < s->materials && s->method != METHOD_MPM && s->dim > 1; m++)
        if (material_yields(&s->material[m]))
            warnings_add(to,
                         "material %s: bonds%s yield one by one, so that a %s of them bears about %.2f times what its "
                         "yield_stress says in tension, %.2f times in shear, and contracts across by %.2f of its "
                         "plastic strain; by von Mises' law, which method mpm has, these are 1, 1 and %s",
                         s->material[m].name, s->method == METHOD_PD ? "" : ", which points convert to,",
                         bonds_bear[s->space].body, bonds_bear[s->space].pull, bonds_bear[s->space].shear,
                         bonds_bear[s->space].across, s->space == SPACE_PLANE_STRAIN ? "1" : "0.5");
}
