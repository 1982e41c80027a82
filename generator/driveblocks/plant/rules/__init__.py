"""The rules of a plant: each module notes what is wrong of one kind; what it can do without is judged all the same."""
