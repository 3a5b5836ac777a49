/* Contact of peridynamic particles, as a part of a run. */
#include "contact/contact.h"
#include "run/part.h"

static void contact_free_all(struct run *e) { contact_free(e->contact); }

const struct part part_contact = {PART(contact, contact), .free = contact_free_all};
