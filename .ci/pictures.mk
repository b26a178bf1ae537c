# What README.md shows
#
#	make readme   its generated parts
#	make html     the pages for a browser, recipes with pictures, in $(BUILD)/html
#	make packed    examples/packed.png, heads of few kilobytes, of $(DATA)/meshes/igea.ply.gz
#	make posing   examples/posing.webp, the picture that moves, of $(DATA)/meshes/armadillo.off.gz, by Chromium
#	make table1   the paper's comparison of solvers, as text and picture, in $(BUILD)/table1

table1: $(TOOLS) $(BUILD)/bench/plot
	@$(RUN) PATH='$(abspath $(BUILD))/bin:$(abspath $(BUILD))/bench:$(PATH)' sh tests/bench/table1.sh \
		'$(BUILD)/table1'

readme:
	@tests/readme >$(BUILD)/README.md && cat $(BUILD)/README.md >README.md
	@tests/findings >$(BUILD)/findings.7 && cat $(BUILD)/findings.7 >man/mr-findings.7

html: $(TOOLS)
	@$(RUN) .ci/html '$(BUILD)/html'

posing: $(TOOLS)
	@$(RUN) sh tests/page/posing '$(DATA)/meshes/armadillo.off.gz' '$(abspath examples/posing.webp)'

packed: $(TOOLS)
	@$(RUN) sh tests/bench/packed.sh '$(DATA)/meshes/igea.ply.gz' '$(abspath examples/packed.png)'

.PHONY: table1 readme html posing packed
