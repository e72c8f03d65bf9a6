"""From analysis to design: goals and limits, tables of operating points, bearings side by side."""
