/* Assigns types of particles in LAMMPS: one for each combination of material and loads, so that groups are lists of
 * types; more where bonds are cut, so that pairs of types identify the bonds to cut. */
#include "base/memory.h"
#include "export_parts.h"

/* Largest number of classes of particles in an export. */
enum { CLASSES_MOST = 1000 };

/* Classes of particles with the same material and loads and, for bond styles, the same mass. any[n]: index of one
 * particle of each class. At cut bonds, colours divide a class into several types. */
struct classes {
    int n;
    int32_t *any;
};

/* Returns true if the particles i and j of the export x can have the same LAMMPS type: if they have the same material,
 * the same loads and, for bond styles, the same mass. */
static bool class_alike(const struct lammps_export *x, int64_t i, int64_t j)
{
    const struct particles *p = &x->e->part;
    return p->material[i] == p->material[j] && x->loads[i] == x->loads[j] &&
           (!x->bond_style || reals_are_bitwise_equal(p->mass[i], p->mass[j]));
}

/* Returns the index in c, from 0, of the class of particle i of the export x. Particles of one class have the same
 * material, the same loads and, for bond styles, the same mass. Adds a class to c if particle i belongs to none.
 * Returns -1 if there would be more than CLASSES_MOST classes. */
static int class_of(struct classes *c, const struct lammps_export *x, int64_t i)
{
    for (int k = c->n; k-- > 0;)
        if (class_alike(x, c->any[k], i)) return k;
    if (c->n == CLASSES_MOST) return -1;
    GROW("types.classes", c->any, c->n + 1);
    c->any[c->n] = (int32_t)i;
    return c->n++;
}

/* Numbers n particle types of the export x from 1, such that the types of one material are consecutive. any[n]: index
 * of a particle of each type before the renumbering; number[n]: receives the new number of each type. Allocates
 * t->material and t->any and fills them in the order of the new numbers. */
static void types_number(struct lammps_types *t, const struct lammps_export *x, int32_t *number, const int32_t *any,
                         int n)
{
    t->material = NEW("types.material", n + 1, int32_t);
    t->any = NEW("types.any", n + 1, int32_t);
    for (int m = 0; m < x->s->materials; m++)
        for (int k = 0; k < n; k++)
            if (x->e->part.material[any[k]] == m) {
                number[k] = ++t->n;
                t->material[t->n] = m, t->any[t->n] = any[k];
            }
}

/* Lists in t->pair, which is allocated, the pairs of particle types between which LAMMPS must not create bonds: the
 * types of the colours a and b with pair[a * colours + b] == PAIR_CUT. number[colours]: type of the particles of each
 * colour. */
static void types_exclude(struct lammps_types *t, const int32_t *number, const uint8_t *pair, int colours)
{
    for (int pass = 0; pass < 2; pass++) {
        t->pairs = 0;
        for (int a = 0; a < colours; a++)
            for (int b = a; b < colours; b++) {
                if (pair[(int64_t)a * colours + b] != PAIR_CUT) continue;
                if (pass) t->pair[t->pairs][0] = number[a], t->pair[t->pairs][1] = number[b];
                t->pairs++;
            }
        if (!pass) t->pair = memory_new("types.pair", t->pairs, sizeof *t->pair);
    }
}

/* Finds the class of every particle of the export x (particles with the same material, loads and, for bond styles,
 * mass) and stores it in t->of, which is allocated. c: receives the classes. Returns REFUSED, with a message, if there
 * are more than CLASSES_MOST classes. */
static status classes_find(struct classes *c, struct lammps_types *t, const struct lammps_export *x)
{
    t->of = NEW("types.of", x->e->part.n, int32_t);
    for (int64_t i = 0; i < x->e->part.n; i++)
        if ((t->of[i] = class_of(c, x, i)) < 0)
            return status_set(REFUSED,
                              "%s: more than %d different combinations of mass, material and loads, each of which "
                              "needs an atom type of LAMMPS; use fewer loads or materials",
                              printable_name(x->s->path).text, CLASSES_MOST);
    return OK;
}

/* Sets the LAMMPS type t->of[i] of every particle i of the export x. It follows from the class of the particle (its
 * material, loads and, for bond styles, mass) or, if the particle is in the list `touched` of particles with cut bonds,
 * from its colour. Lists the excluded pairs of types. colour[touched->n]: colours of the listed particles, 0 .. colours
 * - 1; pair[a * colours + b]: kind of the pair of colours a and b, bonded or cut, or NULL if no bond is cut. Returns
 * REFUSED, with a message, if the particles have more than CLASSES_MOST classes. */
static status types_give(struct lammps_types *t, struct lammps_export *x, const struct particles_at_cut_bonds *touched,
                         const int32_t *colour, int colours, const uint8_t *pair)
{
    const int64_t n = x->e->part.n;
    struct classes c = {0};
    const status made = classes_find(&c, t, x);
    int32_t *any = NEW("types.first", c.n + colours, int32_t), *number = NEW("types.number", c.n + colours, int32_t);
    for (int k = 0; k < c.n; k++) any[k] = c.any[k];
    for (int64_t k = made == OK ? touched->n : 0; k-- > 0;) {
        any[c.n + colour[k]] = touched->particle[k];
        t->of[touched->particle[k]] = c.n + colour[k];
    }
    if (made == OK) types_number(t, x, number, any, c.n + colours);
    for (int64_t i = 0; i < n && made == OK; i++) t->of[i] = number[t->of[i]];
    if (pair && made == OK) types_exclude(t, number + c.n, pair, colours);
    memory_free(any);
    memory_free(number);
    memory_free(c.any);
    return made;
}

status lammps_types_assign_to_particles(struct lammps_types *types, struct lammps_export *x)
{
    struct particles_at_cut_bonds touched;
    *types = (struct lammps_types){0};
    status s = lammps_find_bonds_to_cut(&touched, x);
    int32_t *colour = NEW("types.colour", touched.n, int32_t);
    uint8_t *pair = NULL;
    const int colours =
        s == OK && touched.n > 0 ? particles_at_cut_bonds_assign_and_count_colours(colour, &touched) : 0;
    if (s == OK && touched.n > 0 && colours == 0)
        s = status_set(REFUSED,
                       "%s: the cracks touch %lld particles, which need more than %d atom types, the limit of the "
                       "tables of LAMMPS; use straight cracks along the lattice",
                       printable_name(x->s->path).text, (long long)touched.n, COLOURS_MOST);
    if (s == OK && colours > 0 && !(pair = colour_pairs_classify_as_bonded_or_cut(colour, colours, &touched)))
        s = status_set(FAILED, "export: the cracks cut bonds that the atom types of LAMMPS cannot distinguish from "
                               "uncut ones; use straight cracks");
    if (s == OK) s = types_give(types, x, &touched, colour, colours, pair);
    memory_free(pair);
    memory_free(colour);
    particles_at_cut_bonds_free(&touched);
    return s;
}

void lammps_types_free(struct lammps_types *types)
{
    memory_free(types->of);
    memory_free(types->material);
    memory_free(types->any);
    memory_free(types->pair);
    *types = (struct lammps_types){0};
}
