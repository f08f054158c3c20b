/** A message for people: what is wrong and where; advice: what to do, where that does not say so. */
export class Trouble extends Error {
  constructor(title, words, advice = null) {
    super(words);
    this.title = title;
    this.advice = advice;
  }
}
