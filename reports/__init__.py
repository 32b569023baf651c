"""Who judges: the comparator, work-precision, and the rendering of reports."""
