// Ctrl-C and SIGTERM: the first asks the program to stop at the next iterate, a second one ends it at once
// with exit code 3, leaving no partial files.
#pragma once

namespace pbdcheck {

/// Thrown where the user asked to stop.
struct Interrupted {};

void catch_interrupts();
bool interrupted();
void throw_if_interrupted();

}  // namespace pbdcheck
