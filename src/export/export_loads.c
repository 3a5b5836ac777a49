/* Translates loads to commands of LAMMPS.
 * Prescribed velocities replace the force (fix setforce) such that the velocity in the middle of each step is the
 * prescribed one; prescribed displacements replace it such that each step ends at the prescribed position. Forces are
 * added (fix addforce), as means over the velocity update in which they act. The steps agree with those of Cleave to
 * round-off for any function of time. */
#include <math.h>

#include "base/memory.h"
#include "export_parts.h"

static bool is_force(const struct load *load)
{
    return load->boundary->kind == BOUNDARY_TRACTION || load->boundary->kind == BOUNDARY_BODY_FORCE;
}

static const char axis_name[] = "xyz";
/* Largest number of rows of a table in time that is exported. */
enum { TABLE_MOST = 500 };

/* A word of the script of LAMMPS, returned by value. */
struct word {
    char text[32];
};

static bool is_constant(const struct load *load) { return load->boundary->time.kind == TIME_CONSTANT; }

/* ---- what can be done -------------------------------------------------------------------------------------------- */

/* Returns true if the time function f can be written as a formula of LAMMPS: if it is constant, a step, a pulse, a ramp
 * or a table. */
static bool function_carries(const struct time_function *f)
{
    const enum time_kind kind = f->kind;
    return kind == TIME_CONSTANT || kind == TIME_STEP || kind == TIME_PULSE || kind == TIME_RAMP || kind == TIME_TABLE;
}

static bool has_formula(const struct boundary *b)
{
    bool has = false;
    for (int d = 0; d < DIM_MAX; d++) has |= b->formula[d].n > 0;
    return has;
}

static status load_carries(const struct load *load)
{
    const struct boundary *b = load->boundary;
    const char *why = NULL;
    if (b->kind == BOUNDARY_MIRROR)
        why = "LAMMPS has no planes of symmetry; remove `mirror`, and give the whole body";
    else if (b->kind == BOUNDARY_ABSORBING)
        why = "absorbing faces cannot be exported to LAMMPS; remove `absorbing`, and use a larger body";
    else if (!is_force(load) && b->kind != BOUNDARY_VELOCITY)
        why = "this kind of load cannot be exported to LAMMPS; use traction, body_force, velocity or fixed";
    else if (has_formula(b) || b->rotates)
        why = "formulas and rotation cannot be exported to LAMMPS; use numbers and a function of time";
    else if (!function_carries(&b->time))
        why = "this function of time cannot be exported to LAMMPS; use a table";
    else if (b->time.kind == TIME_TABLE && b->time.n > TABLE_MOST)
        why = "the table is too long, because LAMMPS evaluates all of it in every step; use at most 500 values";
    return why ? status_set(REFUSED, "%s%s", b->place, why) : OK;
}

static void columns_make(struct lammps_export *x);

status lammps_find_loads_of_particles(struct lammps_export *exported)
{
    const struct loads *l = &exported->e->loads;
    for (int k = 0; k < l->n; k++) TRY(load_carries(&l->load[k]));
    if (l->n > LOADS_MOST)
        return status_set(REFUSED, "%s: the scene has %d loads, but LAMMPS has groups for %d only; use fewer loads",
                          printable_name(exported->s->path).text, l->n, LOADS_MOST);
    exported->loads = NEW("export.loads", exported->e->part.n, uint32_t);
    for (int k = 0; k < l->n; k++)
        for (int64_t q = 0; q < l->load[k].n; q++) exported->loads[l->load[k].particle[q]] |= 1u << k;
    columns_make(exported);
    return OK;
}

void lammps_compute_initial_velocity_of_particle(const struct lammps_export *exported, int64_t particle,
                                                 real velocity[DIM_MAX])
{
    const struct loads *l = &exported->e->loads;
    const int dim = exported->e->part.dim;
    for (int d = 0; d < DIM_MAX; d++) velocity[d] = d < dim ? exported->e->part.v[d][particle] : 0;
    for (int k = 0; k < l->n; k++) {
        const struct boundary *b = l->load[k].boundary;
        if (is_force(&l->load[k]) || !(exported->loads[particle] >> k & 1)) continue;
        const struct prescribed_motion by =
            boundary_prescribed_motion_in_step(b, dim, 0.5 * exported->e->clock.dt, exported->e->clock.dt);
        for (int d = 0; d < dim; d++)
            if (b->components >> d & 1) velocity[d] = prescribed_velocity_component_at_position(&by, NULL, d, false);
    }
}

/* ---- columns of plate.data --------------------------------------------------------------------------------------- */

/* Returns component d of the force that `load` of the export x exerts on its k-th particle, from 0, at the factor 1 of
 * its time function. For bond styles of LAMMPS it is the force [N]; for pair styles, in which the density stands for
 * the mass, the force per volume [N/m^3]. */
static real force_on(const struct lammps_export *x, const struct load *load, int d, int64_t k)
{
    const real force = load->boundary->value[d] * load->share[d][k];
    return x->bond_style ? force : force / x->e->part.volume0[load->particle[k]];
}

static bool pushes_along(const struct load *load, int d)
{
    return is_force(load) && load->n > 0 && load->boundary->value[d] != 0;
}

/* Returns true if component d of the forces that `load` of the export x exerts differs between its particles by more
 * than round-off. Only for components in which it exerts a force. */
static bool force_varies(const struct lammps_export *x, const struct load *load, int d)
{
    for (int64_t k = 1; k < load->n; k++)
        if (!(fabs(force_on(x, load, d, k) / force_on(x, load, d, 0) - 1) <= 1e-14)) return true;
    return false;
}

static bool is_displaced(const struct particles *p)
{
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++)
            if (!reals_are_bitwise_equal(p->x[d][i], p->X[d][i])) return true;
    return false;
}

/* Lists in x->column the per-particle columns of the file plate.data that the export x needs. There is one for each
 * component of a force that varies over the particles of its load. If particles are displaced at the start
 * (x->displaced is set), there is also one for each component of displacement. */
static void columns_make(struct lammps_export *x)
{
    const struct loads *l = &x->e->loads;
    for (int k = 0; k < l->n; k++)
        for (int d = 0; d < x->s->dim; d++)
            if (pushes_along(&l->load[k], d) && force_varies(x, &l->load[k], d))
                x->column[x->columns++] = (struct lammps_column){k, d};
    x->displaced = is_displaced(&x->e->part);
    for (int d = 0; x->displaced && d < x->s->dim; d++) x->column[x->columns++] = (struct lammps_column){-1, d};
}

static struct word column_name(const struct lammps_column *c)
{
    struct word w;
    if (c->load < 0)
        snprintf(w.text, sizeof w.text, "start%c", axis_name[c->axis]);
    else
        snprintf(w.text, sizeof w.text, "load%d%c", c->load + 1, axis_name[c->axis]);
    return w;
}

void lammps_write_per_particle_column_names(FILE *file, const struct lammps_export *x)
{
    for (int c = 0; c < x->columns; c++) fprintf(file, " d_%s", column_name(&x->column[c]).text);
}

void lammps_write_compute_commands(FILE *file, const struct lammps_export *x)
{
    for (int c = 0; c < x->columns; c++) {
        const struct word name = column_name(&x->column[c]);
        fprintf(file, "compute %s all property/atom d_%s\n", name.text, name.text);
    }
}

/* Returns the index of particle i in the list load->particle, which is in ascending order; -1 if the particle is not in
 * the list. */
static int64_t index_in_load(const struct load *load, int64_t i)
{
    int64_t low = 0, high = load->n;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (load->particle[middle] < i)
            low = middle + 1;
        else
            high = middle;
    }
    return low < load->n && load->particle[low] == i ? low : -1;
}

real lammps_data_file_column_value(const struct lammps_export *exported, int c, int64_t particle)
{
    const int d = exported->column[c].axis;
    if (exported->column[c].load < 0) return exported->e->part.x[d][particle] - exported->e->part.X[d][particle];
    const struct load *load = &exported->e->loads.load[exported->column[c].load];
    const int64_t k = index_in_load(load, particle);
    return k < 0 ? 0 : force_on(exported, load, d, k);
}

/* ---- functions of time ------------------------------------------------------------------------------------------- */

/* Writes the number `value` with 17 digits to the LAMMPS script `to`, in parentheses if it is negative. Infinite
 * numbers become 1e300 or -1e300. */
static void put(FILE *to, real value)
{
    if (!isfinite(value)) value = value > 0 ? 1e300 : -1e300;
    fprintf(to, value < 0 ? "(%.17g)" : "%.17g", value);
}

/* Writes the formula `text` to the LAMMPS script `to`: each % becomes the next element of number[], each letter t
 * becomes `t`, the name of the time variable, and other characters are copied. */
static void put_formula(FILE *to, const char *text, const char *t, const real *number)
{
    for (; *text; text++)
        if (*text == '%')
            put(to, *number++);
        else if (*text == 't')
            fputs(t, to);
        else
            fputc(*text, to);
}

static void put_table(FILE *to, const struct time_function *f, const char *t)
{
    put_formula(to, "((t<%)*%", t, (real[]){f->t[0], f->value[0]});
    for (int k = 1; k < f->n; k++)
        if (f->t[k] > f->t[k - 1])
            put_formula(to, "+(t>=%)*(t<%)*(%+(t-%)*(%))", t,
                        (real[]){f->t[k - 1], f->t[k], f->value[k - 1], f->t[k - 1],
                                 (f->value[k] - f->value[k - 1]) / (f->t[k] - f->t[k - 1])});
    put_formula(to, "+(t>=%)*%)", t, (real[]){f->t[f->n - 1], f->value[f->n - 1]});
}

/* Writes the time function f as a formula to the LAMMPS script `to`. t: name of the LAMMPS variable with the time. Only
 * for functions that function_carries accepts. */
static void put_function(FILE *to, const struct time_function *f, const char *t)
{
    const real a = f->from, b = f->until;
    switch (f->kind) {
    case TIME_STEP:
        put_formula(to, "((t>=%)*(t<%))", t, (real[]){a, b});
        break;
    case TIME_PULSE:
        put_formula(to, "((t>=%)*(t<%)*", t, (real[]){a, b});
        fputs("sin(PI*(", to);
        put_formula(to, "t-%)/(%-%))^2)", t, (real[]){a, b, a});
        break;
    case TIME_RAMP:
        put_formula(to, "((t>=%)+(t>=%)*(t<%)*(t-%)/(%-%))", t, (real[]){b, a, b, a, b, a});
        break;
    case TIME_TABLE:
        put_table(to, f, t);
        break;
    default:
        fputs("1", to);
    }
}

/* ---- commands ---------------------------------------------------------------------------------------------------- */

/* Writes the LAMMPS command that defines the group of the particles on which load k, from 0, acts, by their types, to
 * the script `to`. t: particle types of LAMMPS, from 1; x: the export. */
static void group_write(FILE *to, int k, const struct lammps_types *t, const struct lammps_export *x)
{
    fprintf(to, "group load%d type", k + 1);
    for (int type = 1; type <= t->n; type++)
        if (x->loads[t->any[type]] >> k & 1) fprintf(to, " %d", type);
    fputc('\n', to);
}

/* Returns component d of the force of load k of the export x as an argument of a LAMMPS command: a number, or the name
 * of a variable if the force depends on time or on the particle. In the latter case the definition of the variable is
 * written to the script `to` first. */
static struct word force_word(FILE *to, const struct lammps_export *x, int k, int d)
{
    const struct load *load = &x->e->loads.load[k];
    struct word w = {"0.0"};
    if (!pushes_along(load, d)) return w;
    const bool atoms = force_varies(x, load, d);
    snprintf(w.text, sizeof w.text, "%.17g", force_on(x, load, d, 0));
    if (!atoms && is_constant(load)) return w;
    fprintf(to, "variable force%d%c %s \"", k + 1, axis_name[d], atoms ? "atom" : "equal");
    if (atoms)
        fprintf(to, "c_load%d%c", k + 1, axis_name[d]);
    else
        put(to, force_on(x, load, d, 0));
    if (!is_constant(load)) fprintf(to, "*v_factor%d", k + 1);
    fputs("\"\n", to);
    snprintf(w.text, sizeof w.text, "v_force%d%c", k + 1, axis_name[d]);
    return w;
}

/* Writes the LAMMPS commands that apply the force of load k of the export x to its particles to the script `to`. LAMMPS
 * uses a force in a velocity update that extends from half a step before to half a step after the time of a step. The
 * time function is therefore replaced by the mean of its values at the beginning and at the end of the update. */
static void force_write(FILE *to, const struct lammps_export *x, int k)
{
    const struct load *load = &x->e->loads.load[k];
    struct word w[DIM_MAX];
    if (!is_constant(load)) {
        fprintf(to, "variable factor%d equal \"0.5*(", k + 1);
        put_function(to, &load->boundary->time, "v_kicked");
        fputc('+', to);
        put_function(to, &load->boundary->time, "v_kick");
        fputs(")\"\n", to);
    }
    for (int d = 0; d < DIM_MAX; d++) w[d] = force_word(to, x, k, d);
    fprintf(to, "fix load%d load%d addforce %s %s %s\n", k + 1, k + 1, w[0].text, w[1].text, w[2].text);
}

/* Writes the definition of a LAMMPS variable for particles of the export x with a prescribed displacement to the script
 * `to`: component d of the force by which they reach the prescribed position at the end of a step. k: number of the
 * load that prescribes the displacement. */
static void displacement_write(FILE *to, const struct lammps_export *x, int k, int d)
{
    const struct boundary *b = x->e->loads.load[k].boundary;
    fprintf(to, "variable drive%d%c atom \"(step>0)*mass*((", k + 1, axis_name[d]);
    put(to, b->value[d]);
    fputc('*', to);
    put_function(to, &b->time, "v_next");
    fprintf(to, "-c_placed[%d])/%.17g-v%c)/%.17g\"\n", d + 1, x->e->clock.dt, axis_name[d], x->e->clock.dt);
}

/* Writes the LAMMPS commands that make the particles of load k of the export x follow its prescribed velocity or
 * displacement to the script `to`. LAMMPS cannot prescribe these; instead, a force replaces the force on the particles
 * in each step. It changes their velocity from the value in the middle of the previous step to the prescribed one in
 * the middle of this step. */
static void drive_write(FILE *to, const struct lammps_export *x, int k)
{
    const struct boundary *b = x->e->loads.load[k].boundary;
    const bool varies = !is_constant(&x->e->loads.load[k]);
    struct word w[DIM_MAX] = {{"NULL"}, {"NULL"}, {"NULL"}};
    if (varies && !b->displaces) {
        fprintf(to, "variable rate%d equal \"(step>0)*(", k + 1);
        put_function(to, &b->time, "v_kick");
        fputc('-', to);
        put_function(to, &b->time, "v_kicked");
        fprintf(to, ")/%.17g\"\n", x->e->clock.dt);
    }
    for (int d = 0; d < x->s->dim; d++) {
        if (!(b->components >> d & 1)) continue;
        strcpy(w[d].text, "0.0");
        if (!varies || b->value[d] == 0) continue;
        snprintf(w[d].text, sizeof w[d].text, "v_drive%d%c", k + 1, axis_name[d]);
        if (b->displaces) {
            displacement_write(to, x, k, d);
            continue;
        }
        fprintf(to, "variable drive%d%c atom \"mass*", k + 1, axis_name[d]);
        put(to, b->value[d]);
        fprintf(to, "*v_rate%d\"\n", k + 1);
    }
    fprintf(to, "fix load%d load%d setforce %s %s %s\n", k + 1, k + 1, w[0].text, w[1].text, w[2].text);
}

void lammps_loads_write(FILE *file, const struct lammps_export *x, const struct lammps_types *types)
{
    const struct loads *l = &x->e->loads;
    bool places = false;
    if (l->n == 0) return;
    for (int k = 0; k < l->n; k++) places |= l->load[k].boundary->displaces;
    fprintf(file,
            "\n# Loads; the kick of a step begins and ends at these times, in the middles of steps\n"
            "variable kick equal \"(step+0.5)*%.17g\"\nvariable kicked equal \"(step-0.5*(step>0))*%.17g\"\n",
            x->e->clock.dt, x->e->clock.dt);
    if (places)
        fprintf(file, "variable next equal \"(step+1)*%.17g\"\ncompute placed all displace/atom\n", x->e->clock.dt);
    for (int k = 0; k < l->n; k++) {
        if (l->load[k].n == 0) continue;
        fprintf(file, "# %s\n", l->load[k].boundary->name);
        group_write(file, k, types, x);
        if (is_force(&l->load[k])) force_write(file, x, k);
    }
    for (int k = 0; k < l->n; k++) /* after all forces, which these commands replace */
        if (l->load[k].n > 0 && !is_force(&l->load[k])) drive_write(file, x, k);
}
