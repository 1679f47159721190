/* Wrong use of the library. */
#ifndef ABUSE_H
#define ABUSE_H

/* Tries all of it, says what is not answered as it has to be, and how much was tried. 0: all is well. */
int abuse(void);

#endif
