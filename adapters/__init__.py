"""Who simulates: one file per engine, the runner and the MCAP log."""
