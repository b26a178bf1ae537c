# mr-solve over MPI
#
#	make mpi        mr-solve-mpi, which divides the factor among processes, by MUMPS, which it installs
#	make check-mpi  its tests

# mr-solve over MPI: MUMPS in the place of CHOLMOD, and what mpi.c says of terminals.
mpi: $(BUILD)/mpi/mr-solve-mpi
$(patsubst %,$(BUILD)/%.o,$(MPI)): ALL_C += $$($(MPICC) --showme:compile)
$(patsubst %,$(BUILD)/%.o,$(MPI)): | setup
$(BUILD)/cmd/mpi-cmd.c.o: cmd/cmd.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(call say,compile)$(CC) $(ALL_C) -Dmain=mr_solve_main -MMD -MP -c -o $@ $<
$(BUILD)/mpi/mr-solve-mpi: $(patsubst %,$(BUILD)/%.o,$(MPI) $(patsubst %,cmd/%.c,mpi-cmd mr-solve findings help \
		options place signals)) $(BUILD)/libmr.a
	@mkdir -p $(@D)
	$(call say,link   )$(CC) $(ALL_C) -pie $(SAFE) $(LDFLAGS) -o $@ $^ $(LIBS) -ldmumps $$($(MPICC) --showme:link)

check-mpi: $(TOOLS) mpi
	@$(RUN) tests/run $(or $(T),mpi/)

.PHONY: check-mpi mpi
