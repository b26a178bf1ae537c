/* film.js -- frames one after another: a slider, one forth and back, play. */
const RATE = 24; /* frames a second, where the browser can */
const $ = (id) => document.getElementById(id);

export class Film {
	/* show(i): a promise of when frame i is drawn. */
	constructor(length, show) {
		this.length = length;
		this.show = show;
		this.at = 0;
		this.playing = false;
		$("film").hidden = length < 2;
		$("time").max = length - 1;
		$("time").addEventListener("input", () => this.go(Number($("time").value)));
		$("before").addEventListener("click", () => this.step(-1));
		$("after").addEventListener("click", () => this.step(1));
		$("play").addEventListener("click", () => this.play(!this.playing));
	}

	/* Stops, and shows a frame; behind the last comes the first. */
	go(i) {
		this.play(false);
		return this.turn(i);
	}

	step(by) {
		return this.go(this.at + by);
	}

	turn(i) {
		this.at = (i + this.length) % this.length;
		$("time").value = this.at;
		$("number").textContent = this.at + 1 + " / " + this.length;
		return this.show(this.at);
	}

	play(on) {
		const started = this.playing;

		this.playing = on && this.length > 1;
		$("play").textContent = this.playing ? "❚❚" : "▶";
		$("play").title = this.playing ? "Stop (space)" : "Play (space)";
		if (this.playing && !started)
			this.run();
	}

	async run() {
		while (this.playing) {
			const began = performance.now();
			await this.turn(this.at + 1);
			await new Promise((done) => setTimeout(done,
				Math.max(1000 / RATE - (performance.now() - began), 0)));
		}
	}
}
