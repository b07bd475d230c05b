"""Everything that docs/comparison.md shows: `python benches/peers > comparison.txt`."""

import os
import platform
import warnings

import air
import bouncing
import events
import rough
import slips

if __name__ == "__main__":
    warnings.simplefilter("ignore")
    print(f"{platform.machine()}, {os.cpu_count()} cores, Python {platform.python_version()}")
    for table in (bouncing.elastic, bouncing.lossy, bouncing.dropped):
        table(bouncing.PEERS)
    for table in rough.TABLES.values():
        table(rough.PEERS)
    air.pendulum_table()
    air.throw_table()
    events.equal_error_table()
    slips.refused()
    slips.taken()
