/* Prints the lines of `cleave check` about bodies in several pieces: separate parts in particle lists and images, and
 * parts that pre-cracks cut off. */
#include <stdio.h>

#include "base/memory.h"
#include "check_parts.h"
#include "fracture/fragments.h"

/* Sets driven[k] to true for each fragment k of f in which a support prescribes the motion of a particle of `part`. If
 * `source` has a plane of symmetry, sets driven[k] of all fragments to true, since the plane may constrain any
 * fragment. */
static void mark_driven(const struct bond_source *source, const struct particles *part, const struct fragments *f,
                        bool *driven)
{
    for (int64_t k = 0; k < f->n; k++) driven[k] = source->mirrors > 0;
    for (int64_t i = 0; i < part->n; i++)
        if (f->of[i] >= 0 && part->flag[i] & FLAG_DRIVEN) driven[f->of[i]] = true;
}

/* Prints about the fragments f of body number `body`: their number, the position of the second heaviest one, whether a
 * fragment lacks a support if scene s (the input file) is static, and whether fragments that touch pass through each
 * other because contact within a body is off. Prints nothing for a body in one piece. driven[f->n]: true for fragments
 * with a support. Particles without any bond are not fragments; a warning reports them. */
static void say_body(const struct scene *s, const struct fragments *f, const bool *driven, int body)
{
    int64_t pieces = 0, particles = 0, free_ones = 0, first = -1;
    for (int64_t k = 0; k < f->n; k++) {
        if (f->fragment[k].body != body) continue;
        if (++pieces == 1) continue;
        particles += f->fragment[k].particles;
        free_ones += scene_is_single_equilibrium(s) && !driven[k];
        if (first < 0) first = k;
    }
    if (pieces < 2) return;
    const bool pass = scene_is_dynamic(s) && s->contact_between != CONTACT_ALL;
    printf("pieces         body %s consists of %lld parts without bonds between them; all parts but the heaviest have "
           "%lld particles together, and the second heaviest is at (%s) m%s%s\n",
           s->body[body].name, (long long)pieces, (long long)particles,
           position_text(f->fragment[first].x, s->dim, 4).text,
           free_ones > 0 ? "; some parts have no support, so no equilibrium exists; add supports" : "",
           pass ? "; parts that touch pass through each other; set contact.between: all to prevent this" : "");
}

void print_bodies_in_several_unbonded_pieces(const struct run *run)
{
    struct fragments f;
    if (run->scene->method != METHOD_PD) return;
    fragments_find_by_intact_bonds(&f, &run->bonds, &run->part);
    bool *driven = NEW("check.driven", f.n, bool);
    mark_driven(&run->source, &run->part, &f, driven);
    for (int b = 0; b < run->scene->bodies; b++) say_body(run->scene, &f, driven, b);
    memory_free(driven);
    fragments_free(&f);
}
