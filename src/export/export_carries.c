/* Determines which features of an input file LAMMPS can simulate. Features without a LAMMPS command are refused;
 * features for which LAMMPS has one fixed rule become keys that must be changed. */
#include <math.h>

#include "export_parts.h"

static status lammps_refuse(const struct scene *s, const char *what)
{
    return status_set(REFUSED, "%s: %s", printable_name(s->path).text, what);
}

static bool stretches_differ(const struct scene *s)
{
    for (int m = 1; m < s->materials; m++)
        if (!reals_are_bitwise_equal(s->material[m].critical_stretch, s->material[0].critical_stretch)) return true;
    for (int k = 0; k < s->interfaces; k++)
        if (s->interface[k].critical_stretch > 0) return true;
    return false;
}

static bool any_yields(const struct scene *s)
{
    bool yields = false;
    for (int m = 0; m < s->materials; m++) yields |= material_yields(&s->material[m]);
    return yields;
}

static status carries_method(const struct scene *s)
{
    if (s->method == METHOD_MPM)
        return lammps_refuse(s, "method: mpm cannot be exported: it has no bonds, and LAMMPS lacks its kind of "
                                "material points; set method: pd or adaptive");
    if (s->dim == 1) return lammps_refuse(s, "space: line does not exist in LAMMPS; set a plane space or solid");
    if (!scene_is_dynamic(s))
        return lammps_refuse(s, "solver: peridynamics in LAMMPS has time steps only; set solver: explicit");
    if (s->model == MODEL_MOSPD)
        return lammps_refuse(s, "model: mospd does not exist in LAMMPS; set model: bond (peri/pmb) or ospd (peri/lps)");
    return OK;
}

static status carries_materials(const struct scene *s, bool bond_style)
{
    if (any_yields(s))
        return lammps_refuse(s, "yield_stress: metals that yield cannot be exported to LAMMPS; set yield_stress: inf");
    for (int m = 0; m < s->materials; m++)
        if (material_has_softening_bonds(&s->material[m]))
            return lammps_refuse(s, "tensile_strength: LAMMPS has no bonds that soften; remove it (bonds are then "
                                    "brittle, and their strength is E s_c)");
    if (s->model == MODEL_OSPD && s->materials > 1)
        return lammps_refuse(
            s, "peri/lps joins two materials by other rules than Cleave; use one material, or model: bond");
    if (stretches_differ(s) && !bond_style)
        return lammps_refuse(s, "several critical stretches: peri/pmb applies to each bond the largest one of its "
                                "particle (lammps issue 984); give all materials the same, or use --style bpm");
    if (s->rigids > 0)
        return lammps_refuse(
            s, "rigid bodies cannot be exported to LAMMPS; use a body of particles that a boundary drives");
    if (scene_has_random_strength(s))
        return lammps_refuse(
            s, "a strength that scatters in space cannot be exported to the atom types of LAMMPS; remove scatter");
    if (s->damping > 0) return lammps_refuse(s, "damping cannot be exported to LAMMPS; set damping: 0");
    if (scene_any_material_has_bulk_viscosity(s))
        return lammps_refuse(s, "viscosity: bulk viscosity cannot be exported to LAMMPS; remove this key");
    if (s->growths > 0) return lammps_refuse(s, "growth: LAMMPS has no cracks with prescribed growth; remove this key");
    return OK;
}

/* Appends a setting to the list `to`, a key of the scene that the export must change, if `differs` is true. key, value:
 * name and new value of the key; effect: how the change affects results, in words. The texts are kept by reference. */
static void settings_add(struct lammps_settings *to, bool differs, const char *key, const char *value,
                         const char *effect)
{
    if (differs) to->of[to->n++] = (struct lammps_setting){key, value, effect};
}

/* Appends to the list `to` the settings of contact that an export of the scene s must change; none if s has no contact.
 * own: true if the pair style of LAMMPS includes a contact law, whose rules the settings must follow; false if it has
 * none, contact is then switched off. */
static void contact_settings(struct lammps_settings *to, const struct scene *s, bool own)
{
    static const char *const effect =
        "fragments that touch repel each other by LAMMPS' law for pairs of particles, not by that of Cleave";
    if (s->contact_between == CONTACT_NONE) return;
    if (!own) {
        settings_add(to, true, "contact.between", "none", "fragments that touch pass through each other");
        return;
    }
    settings_add(to, s->contact_between != CONTACT_ALL, "contact.between", "all", effect);
    settings_add(to, s->contact_form != CONTACT_PAIR, "contact.law", "pair", effect);
    settings_add(to, s->contact_distance != DISTANCE_LAMMPS, "contact.distance", "lammps", effect);
    settings_add(to, s->contact_friction > 0, "contact.friction", "0", "faces slide without friction");
    settings_add(to, s->contact_stiffness != 1, "contact.stiffness", "1", effect);
}

bool lammps_keeps_weighted_volume_after_bonds_break(const struct scene *s)
{
    return s->model == MODEL_OSPD && scene_bonds_can_break(s);
}

/* Appends to the list `to` the peridynamic settings of the scene s that differ from the fixed rules of LAMMPS, with the
 * effect of changing them. bond_style: true for an export for bond_style bpm/peri, false for a pair_style. */
static void pd_settings(struct lammps_settings *to, const struct scene *s, bool bond_style)
{
    const bool state = s->model == MODEL_OSPD, touches = s->contact_between != CONTACT_NONE && !state;
    const bool any_volume = !bond_style && !touches && s->volume == VOLUME_WHOLE;
    settings_add(to, s->volume != VOLUME_CUT_RAMP && !any_volume, "pd.volume", "cut-ramp",
                 "neighbours at the edge of the horizon count by their share within it: stiffness is calibrated anew, "
                 "wave speeds differ by a few percent");
    settings_add(to, s->calibration == CALIBRATION_VMPD, "pd.calibration", "lattice",
                 "stiffness is that of a full neighbourhood on the lattice");
    settings_add(to, s->surface != SURFACE_NONE, "pd.surface", "none",
                 "bonds near faces keep their plain weight: faces are softer, thin parts bend more");
    settings_add(to, s->shells != SHELLS_UNIFORM, "pd.weights", "uniform",
                 "all bonds have the same weight: the lattice keeps its anisotropy of a few percent");
    settings_add(to, s->influence != (state ? INFLUENCE_INVERSE : INFLUENCE_ONE), "pd.influence",
                 state ? "inverse" : "one", "the weight of a bond is another function of its length");
    settings_add(to, state && s->bulk, "pd.normalisation", "local",
                 "constants come from the neighbourhood that a particle has, so those of particles at faces differ");
    settings_add(to, scene_bonds_can_break(s) && s->last_force != LAST_FORCE_WHOLE, "pd.last_force", "whole",
                 "a bond acts for the whole step in which it breaks: it breaks one step later, which decides between "
                 "two almost equal paths of a crack");
}

status lammps_list_input_changes_for_equal_results(struct lammps_settings *changes, const struct scene *s,
                                                   bool bond_style)
{
    changes->n = 0;
    TRY(carries_method(s));
    TRY(carries_materials(s, bond_style));
    pd_settings(changes, s, bond_style);
    contact_settings(changes, s, !bond_style && s->model == MODEL_BOND);
    return OK;
}
