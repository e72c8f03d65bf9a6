"""What judges: bearings and contacts from the drawing alone; nothing here comes from `qsbearing`."""
