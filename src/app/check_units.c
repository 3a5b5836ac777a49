/* What `cleave check` says of numbers that look like those of another unit: a scene in mm, a modulus in MPa, a
 * stretch in percent. */
#include <math.h>

#include "check_parts.h"

#define STIFF 1e9 /* [Pa] from this modulus on, what is said here of solids holds; scaled models lie below */
#define STRETCH_LIKELY                                                                                                 \
    0.05                  /* E s_c beyond a twentieth of E comes near the strength of a crystal without flaws, E/10    \
                           */
#define FASTEST 25e3      /* [m/s] in diamond waves go at 18 km/s */
#define STRAIN_LIKELY 0.2 /* load over modulus */

/* In the time of the run waves do not reach the next particle: lengths, the modulus or the time have another unit. */
static void unlikely_duration(const struct scene *s, const struct material_tables *tables, FILE *out)
{
    const real way = tables->wave_speed * s->duration;
    if (s->solver != SOLVER_EXPLICIT || !(way < s->spacing)) return;
    fprintf(out,
            "unlikely: in the duration of %.3g s waves of %.4g m/s go %.3g m, %.2g spacings: see whether duration, "
            "lengths (mm?) and young (GPa?) have the units that are meant\n",
            s->duration, tables->wave_speed, way, way / s->spacing);
}

static void unlikely_materials(const struct scene *s, FILE *out)
{
    for (int m = 0; m < s->materials; m++) {
        const struct material *a = &s->material[m];
        if (a->young >= STIFF && isfinite(a->critical_stretch) && a->critical_stretch > STRETCH_LIKELY)
            fprintf(out,
                    "unlikely: material %s: its bonds break at a stretch of %.3g, %.3g Pa, where solids without flaws "
                    "bear about a tenth of Young's modulus and others far less: see whether critical_stretch (%%?), "
                    "energy_release_rate or toughness has the unit that is meant\n",
                    a->name, a->critical_stretch, a->critical_stretch * a->young);
        if (a->wave_speed > FASTEST)
            fprintf(
                out,
                "unlikely: material %s: waves at %.3g m/s; in diamond they go at 18000: see whether young and density "
                "(kg/m^3) have the units that are meant\n",
                a->name, a->wave_speed);
    }
}

/* Tractions and pressures beside the least modulus. */
static void unlikely_loads(const struct scene *s, FILE *out)
{
    real young = INFINITY;
    for (int m = 0; m < s->materials; m++) young = real_min(young, s->material[m].young);
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *a = &s->boundary[b];
        real most = 0;
        if (a->kind != BOUNDARY_TRACTION && a->kind != BOUNDARY_PRESSURE) continue;
        for (int d = 0; d < (a->kind == BOUNDARY_PRESSURE ? 1 : s->dim); d++) most = real_max(most, fabs(a->value[d]));
        if (!(most > STRAIN_LIKELY * young)) continue;
        fprintf(out,
                "unlikely: boundary %s: %.3g Pa is %.3g of Young's modulus, %.3g Pa: see whether both have the units "
                "that are meant (MPa, GPa)\n",
                a->name, most, most / young, young);
    }
}

void advise_units(const struct run *e, FILE *out)
{
    unlikely_duration(e->scene, &e->tables, out);
    unlikely_materials(e->scene, out);
    unlikely_loads(e->scene, out);
}
