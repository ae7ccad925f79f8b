// The families of the ledger's rows, one source each: each appends its rows.
#pragma once

#include "ledger/ledger.h"

namespace pbdcheck::ledger {

using Ledger = std::vector<LedgerRow>;

void oscillators(Ledger& rows);
void particles(Ledger& rows);
void pendulums(Ledger& rows);
void chains(Ledger& rows);
void falling_chains(Ledger& rows);
void free_bodies(Ledger& rows);
void tops(Ledger& rows);
void mechanisms(Ledger& rows);
void sliding(Ledger& rows);
void rolling(Ledger& rows);
void impacts(Ledger& rows);
void contact_springs(Ledger& rows);
void thresholds(Ledger& rows);
void jams(Ledger& rows);
void carried(Ledger& rows);
void solids(Ledger& rows);
void bars(Ledger& rows);
void loaded_bars(Ledger& rows);
void hertz(Ledger& rows);
void cantilevers(Ledger& rows);
void elasticas(Ledger& rows);
void membranes(Ledger& rows);
void shells(Ledger& rows);
void rates(Ledger& rows);
void unreachable(Ledger& rows);
void baseline_rows(Ledger& rows);

}  // namespace pbdcheck::ledger
