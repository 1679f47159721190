/* Stands in for the firmware's header of this name: variables that the operator sets. The real one comes from the
 * firmware's tree. */
#ifndef PARAM_H
#define PARAM_H

/* The group's variables as a table of ours. */
struct stub_param {
    const char *name;
    void *address;
};
#define PARAM_GROUP_START(group) \
    extern const struct stub_param stub_param_##group[]; \
    const struct stub_param stub_param_##group[] = {
#define PARAM_ADD(type, name, address) { #name, address },
#define PARAM_GROUP_STOP(group) { 0, 0 } };

#endif
