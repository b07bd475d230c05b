// Pictures of an index: each motion plays by itself while it is on the screen, over and over, until somebody stops it.

/** Milliseconds between the end of a motion and its beginning. */
const REST_BETWEEN = 900;
const pauseAll = document.getElementById("pause-all");

class Living extends Player {
  constructor(figure, data) {
    super(figure, data);
    this.isStopped = calm.matches;
    const name = plain(this.motion.name);
    if (name) make("figcaption", {}, figure).textContent = name;
    this.svg.addEventListener("click", () => (this.isStopped = !this.playing));
    this.button.addEventListener("click", () => (this.isStopped = !this.playing));
    new IntersectionObserver(([{ isIntersecting }]) => this.see(isIntersecting)).observe(figure);
  }

  /** It has its own time. */
  agree() {}

  tell() {}

  see(is) {
    this.isSeen = is;
    if (is && !this.isStopped) this.play();
    else this.pause();
  }

  tick(now) {
    super.tick(now);
    if (this.playing || !this.isOver) return;
    setTimeout(() => this.isSeen && !this.isStopped && !this.playing && this.play(), REST_BETWEEN);
  }
}

const living = [...document.querySelectorAll("[data-living]")].map((figure) => new Living(figure, DATA.motions[Number(figure.dataset.living)]));
pauseAll.hidden = !living.length;
pauseAll.setAttribute("aria-pressed", calm.matches);
pauseAll.addEventListener("click", () => {
  const stops = pauseAll.getAttribute("aria-pressed") !== "true";
  pauseAll.setAttribute("aria-pressed", stops);
  for (const one of living) {
    one.isStopped = stops;
    one.see(one.isSeen);
  }
});
